#!/bin/sh
# Writes viewer.js anew from source/ and the locked packages; needs Node.js 18 or newer and npm. Users need neither.
set -eu
export LC_ALL=C
cd -- "$(dirname -- "$0")"
npm ci --silent --ignore-scripts --no-audit --no-fund
built=$(mktemp)
trap 'rm -f -- "$built"' EXIT INT TERM
node_modules/.bin/esbuild source/main.js --bundle --minify --format=iife --target=es2022 --legal-comments=none \
    --charset=utf8 --log-level=warning --outfile="$built" --allow-overwrite
# The hash of what it was built from: a test holds it against the sources.
hash=$(cat source/*.js package.json package-lock.json | sha256sum | cut -c1-64)
{
    printf '// The live view of fluxbore, with three.js (MIT, see LICENSE.three.txt). Built by build.sh; sources %s\n' "$hash"
    cat "$built"
} >viewer.js
rm -rf node_modules
wc -c viewer.js
