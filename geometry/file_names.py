"""Names of CAD files, the same whatever their format."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from fluxbore.geometry.parts_list import Item

PARTS = "parts"
"""The folder that holds a file for each item of the parts list."""

LONGEST_NAME = 80
"""Bytes of a file's name, its ending left out."""

DEVICES = re.compile(r"(con|prn|aux|nul|(com|lpt)[0-9])(\..*)?", re.IGNORECASE)
"""What Windows takes for a device, whatever ending follows."""


def file_name(name: str) -> str:
    """The name with everything that some file system or shell minds turned into hyphens: "end cap, rod end" becomes
    "end-cap-rod-end"."""
    safe = re.sub(r"[^\w.+]+", "-", name).strip("-.")
    # File systems take 255 bytes at most, and a folder's listing reads better with far fewer.
    safe = safe.encode()[:LONGEST_NAME].decode(errors="ignore").strip("-.") or "unnamed"
    return f"_{safe}" if DEVICES.fullmatch(safe) else safe


def item_stems(items: Sequence[Item]) -> list[str]:
    """How the files of the parts list's items are called, their endings left out; no two alike."""
    return unlike([file_name(item.name).lower() for item in items])


def unlike(names: Sequence[str]) -> list[str]:
    """The same names with a number where one came before."""
    seen: dict[str, int] = {}
    result = []
    for name in names:
        seen[name] = seen.get(name, 0) + 1
        result.append(name if seen[name] == 1 else f"{name}-{seen[name]}")
    return result
