"""`fluxbore export`: the design's files."""

from __future__ import annotations

import argparse
from typing import Any

from fluxbore.spec_options import path_name, read_spec, with_spec

FORMATS = ("step", "bom", "dxf", "fem", "all")
"""As in `fluxbore.exporting`, which is not loaded for --help."""


def add_to(command: argparse.ArgumentParser) -> None:
    """The command's arguments."""
    with_spec(command)
    command.add_argument("-o", "--output", metavar="DIR", type=path_name, required=True, help="folder for the files")
    command.add_argument(
        "--format", choices=FORMATS, action="append", help="default: step; give it several times for several"
    )
    command.add_argument("--schema", choices=("AP242", "AP214"), default="AP242", help="of STEP files; default: AP242")
    command.add_argument("--force", action="store_true", help="take a folder that holds other files")
    command.add_argument("--json", action="store_true", help="print JSON")


def run(options: argparse.Namespace) -> str | dict[str, Any]:
    """Write the files; what to print, text or JSON."""
    from fluxbore.api import export

    found = export(
        read_spec(options),
        options.output,
        force=options.force,
        form=options.format or ["step"],
        schema=options.schema,
    )
    files = [str(path) for path in found]
    return {"status": "ok", "reasons": [], "files": files} if options.json else "\n".join(files)
