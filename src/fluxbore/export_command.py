"""`fluxbore export`: the design's files."""

from __future__ import annotations

import argparse
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from fluxbore.snap_messages import snap_lines, snap_plain
from fluxbore.spec_options import path_name, read_spec, with_spec

if TYPE_CHECKING:
    from fluxbore.geometry.standing import Standing

FORMATS = ("step", "bom", "dxf", "svg", "pdf", "winding", "fem", "vtu", "glb", "stl", "3mf", "all")
"""As in `fluxbore.exporting`, which is not loaded for --help."""


def add_to(command: argparse.ArgumentParser) -> None:
    """The command's arguments."""
    with_spec(command)
    command.add_argument("-o", "--output", metavar="DIR", type=path_name, required=True, help="folder for the files")
    command.add_argument(
        "--format", choices=FORMATS, action="append", help="default: step; give it several times for several"
    )
    command.add_argument("--schema", choices=("AP242", "AP214"), default="AP242", help="of STEP files; default: AP242")
    command.add_argument(
        "--snap",
        choices=("catalogue",),
        help="put what is bought to the nearest catalogue sizes first, and say what that does to the figures",
    )
    command.add_argument("--force", action="store_true", help="take a folder that holds other files")
    command.add_argument("--json", action="store_true", help="print JSON")


def run(options: argparse.Namespace) -> tuple[bool, str | dict[str, Any]]:
    """Write the files. Whether the parts fit one another; what to print, text or JSON."""
    from fluxbore.exporting import export_checked

    spec, formats = read_spec(options), options.format or ["step"]
    snapped = None
    if options.snap:
        from fluxbore.snapping import snap

        snapped = snap(spec)
        spec = snapped.spec
    found = export_checked(
        spec, options.output, formats, schema=options.schema, force=options.force, own_text=snapped is not None
    )
    files = [str(path) for path in found.files]
    reasons = [reason for standing in found.standings for reason in _reasons(standing)]
    status, sound = "ok" if found.sound else "parts overlap", found.sound
    if snapped is not None and not snapped.ok:
        status, sound = "limits not met" if found.sound else status, False
        reasons += snapped.reasons
    if not options.json:
        told = snap_lines(snapped) if snapped is not None else []
        return sound, "\n".join([*told, *files, *(_line(standing) for standing in found.standings), *reasons])
    plain: dict[str, Any] = {"status": status, "reasons": reasons, "files": files}
    if found.standings:
        plain["places"] = [asdict(standing) for standing in found.standings]
    if snapped is not None:
        plain["snap"] = snap_plain(snapped)
    return sound, plain


def _reasons(standing: Standing) -> list[str]:
    """A sentence for each two parts that overlap and should not."""
    return [
        f"{item.first} and {item.second} must not overlap, {standing.place}; they share {_volume(item.volume)}."
        for item in standing.interferences
        if not item.designed
    ]


def _line(standing: Standing) -> str:
    """One place: what is squeezed by design, and the narrowest gap that moves."""
    designed = [item for item in standing.interferences if item.designed]
    squeezes = ", ".join(f"{item.first} in {item.second} {_volume(item.volume)}" for item in designed)
    gap = standing.gap
    told = [
        f"squeezed by design: {squeezes}" if designed else "",
        f"narrowest gap {gap.distance * 1e3:.4g} mm, {gap.first} to {gap.second}" if gap is not None else "",
    ]
    where = f"{standing.place}, {standing.position * 1e3:.6g} mm: "
    return where + ("; ".join(words for words in told if words) or "no parts overlap")


def _volume(volume: float) -> str:
    return f"{volume * 1e9:.3g} mm³"
