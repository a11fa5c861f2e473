"""The live view of the parts: what the page's script needs to draw them, and the script itself.

The script is built from ``assets/viewer/source`` and three.js by ``assets/viewer/build.sh`` and comes with the package.
"""

from __future__ import annotations

import base64
import gzip

from fluxbore.reports.content import ReportContent
from fluxbore.reports.scripts import Data, Script, load

SCRIPT = "viewer/viewer.js"
IDENTIFIER = "viewer-data"


def viewer(content: ReportContent) -> tuple[tuple[Script, ...], tuple[Data, ...]]:
    """The scripts and their data; none where the content has no model."""
    if content.model is None:
        return (), ()
    packed = base64.b64encode(gzip.compress(content.model, 9, mtime=0)).decode("ascii")
    outside = content.assembly.outside if content.assembly is not None else ""
    value = {"title": content.design_spec.word("actuator.name"), "outside": outside, "model": packed}
    return load(SCRIPT), (Data(IDENTIFIER, value),)
