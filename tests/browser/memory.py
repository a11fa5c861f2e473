"""Memory of a browser with all of its processes, as Linux counts it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path


def resident(process: int) -> tuple[int, int]:
    """Bytes of a process and all that it has started: the sum of what each holds, pages that several share counted
    for each; and the sum of each one's share of them, which is what the machine has to give."""
    whole = shared = 0
    for number in _family(process):
        with suppress(OSError):  # it may have ended meanwhile
            fields = dict(_fields(Path(f"/proc/{number}/smaps_rollup").read_text(encoding="ascii")))
            whole += fields["Rss"]
            shared += fields["Pss"]
    return whole, shared


def _family(process: int) -> list[int]:
    """The process and its descendants."""
    children: dict[int, list[int]] = {}
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            with suppress(OSError):
                parent = int((entry / "stat").read_text(encoding="utf-8").rpartition(")")[2].split()[1])
                children.setdefault(parent, []).append(int(entry.name))
    found = [process]
    for number in found:
        found += children.get(number, [])
    return found


def _fields(text: str) -> Iterator[tuple[str, int]]:
    for line in text.splitlines():
        name, _, rest = line.partition(":")
        if rest.endswith(" kB"):
            yield name, int(rest.split()[0]) * 1024
