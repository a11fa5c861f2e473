"""Gathers what a report shows: the one place where results of every room meet."""

from __future__ import annotations

import math
import platform
import sys
from collections.abc import Mapping, Sequence
from importlib.metadata import PackageNotFoundError, version
from typing import TYPE_CHECKING

from fluxbore import __version__
from fluxbore.design.errors import MissingLibraryError
from fluxbore.design.spec import Spec
from fluxbore.geometry.assembly import Assembly, interferences
from fluxbore.geometry.helical_clearance import narrowest
from fluxbore.geometry.helical_part import HelicalPart
from fluxbore.geometry.mass import PartMass, part_masses
from fluxbore.optimize.design_key import source_hash
from fluxbore.optimize.evaluation import Evaluation

if TYPE_CHECKING:
    from fluxbore.reports.content import PartRow, Picture


def picture(parts: Assembly) -> Picture:
    """The assembly with its stator cut open, rendered; without graphics libraries the reason why not."""
    from fluxbore.geometry.step import tessellate
    from fluxbore.reports.content import Picture
    from fluxbore.reports.scene import render_picture

    try:
        meshes = tessellate(parts, 2e-5, cut_away=True)
    except MissingLibraryError as error:
        return Picture(None, str(error))
    return render_picture(meshes)


def part_rows(spec: Spec, parts: Assembly) -> tuple[PartRow, ...]:
    """The parts list; parts that differ by their place alone share a line."""
    from fluxbore.reports.content import PartRow

    alike: dict[tuple[object, ...], list[PartMass]] = {}
    for row in part_masses(parts, spec.materials):
        key = (row.part.role, row.part.group, row.part.material, _size(row), f"{row.volume:.7e}")
        alike.setdefault(key, []).append(row)
    rows = []
    for same in alike.values():
        part = same[0].part
        name = part.name if len(same) == 1 else part.role
        material = part.material or "envelope only"
        rows.append(PartRow(name, part.group, material, _size(same[0]), same[0].volume, same[0].mass, len(same)))
    if parts.carried_mass > 0:
        rows.append(PartRow("carried along, not drawn", "mover", "", "", 0.0, parts.carried_mass))
    return tuple(rows)


def _size(row: PartMass) -> str:
    """Outer and inner diameter and length of the part's envelope, as on a drawing; of a helix also how it winds."""
    radii, heights = zip(*row.part.profile, strict=True)
    bore = f" / \N{LATIN CAPITAL LETTER O WITH STROKE}{2e3 * min(radii):.5g}" if min(radii) > 0 else ""
    length = (max(heights) - min(heights)) * 1e3
    ring = f"\N{LATIN CAPITAL LETTER O WITH STROKE}{2e3 * max(radii):.5g}{bore} \N{MULTIPLICATION SIGN} {length:.5g} mm"
    return f"{ring}, {_winding(row.part)}" if isinstance(row.part, HelicalPart) else ring


def _winding(part: HelicalPart) -> str:
    around = f"{math.degrees(part.angle):.4g}°" if part.angle <= math.tau else f"{part.angle / math.tau:.4g} turns"
    if part.lead == 0.0:
        return around
    return f"{around} of a helix {part.width * 1e3:.5g} mm wide, lead {part.lead * 1e3:.5g} mm"


def checked(parts: Assembly, squeeze: str = "") -> tuple[str, ...]:
    """What was looked at and held beyond what the page sees by itself, in sentences with the figures.

    squeeze : what overlaps by design, in words.
    """
    found = interferences(parts)
    designed = [item for item in found if item.designed]
    sentences = []
    if all(item.designed for item in found):
        volume = sum(item.volume for item in designed) * 1e9
        but = f"none but {squeeze or 'what is designed'}, {volume:.3g} mm³ in all" if designed else "none"
        sentences.append(f"Interference of all {len(parts.parts)} parts in their section: {but}.")
    else:
        names = "; ".join(f"{item.first} and {item.second}" for item in found if not item.designed)
        sentences.append(f"Interference: {names} overlap.")
    helical = [part for part in parts.parts if isinstance(part, HelicalPart)]
    if helical:
        sentences.append(_gaps(helical))
    return tuple(sentences)


def _gaps(parts: Sequence[HelicalPart]) -> str:
    """The narrowest gaps of helical parts; what has none of a kind is not spoken of."""
    found = narrowest(parts)
    pairs = (
        (f"{found.radial * 1e3:.4g} mm between the members", "the members touch", found.radial),
        (f"{found.axial * 1e3:.4g} mm along the axis", "neighbours touch along the axis", found.axial),
        (f"{math.degrees(found.angular):.4g}° around it", "ends touch around it", found.angular),
    )
    told = [words if gap > 0 else touch for words, touch, gap in pairs if math.isfinite(gap)]
    return f"Narrowest gaps of the magnets, from their outlines: {', '.join(told)}."


def provenance(spec: Spec, evaluation: Evaluation | None, command: Sequence[str] | None = None) -> Mapping[str, str]:
    """Versions, hashes, mesh: what somebody needs who wants to see the same figures again."""
    from datetime import UTC, datetime

    rows = {
        "fluxbore": f"{__version__}, sources {source_hash()[:16]}",
        "specification": f"SHA-256 {spec.fingerprint()}",
        "Python": f"{sys.version.split()[0]} on {platform.system()} {platform.machine()}",
    }
    for package in ("numpy", "scipy", "nlopt", "cadquery", "matplotlib"):
        try:
            rows[package] = version(package)
        except PackageNotFoundError:
            rows[package] = "not installed"
    details = (evaluation.details if evaluation is not None else None) or {}
    if "elements" in details:
        rows["mesh"] = (
            f"{details['elements']:.0f} quadratic triangles, {details['unknowns']:.0f} unknowns, "
            f"refinement {spec.values['solver.mesh_refinement']}"
        )
    if command is not None:
        rows["command"] = "fluxbore " + " ".join(command)
    rows["date"] = datetime.now(UTC).strftime("%Y-%m-%d %H:%M UTC")
    return rows
