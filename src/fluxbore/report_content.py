"""Gathers what a report shows: the one place where results of every room meet."""

from __future__ import annotations

import math
import platform
import sys
from collections.abc import Mapping, Sequence
from importlib.metadata import PackageNotFoundError, version
from typing import TYPE_CHECKING

from fluxbore import __version__
from fluxbore.design.spec import Spec
from fluxbore.geometry.assembly import Assembly, interferences
from fluxbore.geometry.helical_clearance import narrowest
from fluxbore.geometry.helical_part import HelicalPart
from fluxbore.geometry.part_size import size_text
from fluxbore.optimize.design_key import source_hash
from fluxbore.optimize.evaluation import Evaluation

if TYPE_CHECKING:
    from fluxbore.reports.content import PartRow, Picture


def picture(parts: Assembly) -> Picture:
    """The assembly with its stator cut open, rendered; without graphics libraries the reason why not."""
    from fluxbore.geometry.model import VIEWED
    from fluxbore.geometry.part_surface import surface
    from fluxbore.reports.scene import render_picture

    found = [(part, surface(part, VIEWED, cut_open=part.group == parts.outside)) for part in parts.parts]
    return render_picture([(part.name, part.colour, shown.points, shown.triangles) for part, shown in found])


def model(spec: Spec, parts: Assembly) -> bytes:
    """The parts as GLB, for the live view."""
    from fluxbore.geometry.gltf import glb
    from fluxbore.geometry.model import VIEWED, shapes
    from fluxbore.geometry.parts_list import parts_list

    return glb(parts, shapes(parts_list(parts, spec.materials), VIEWED), spec.materials)


def part_rows(spec: Spec, parts: Assembly) -> tuple[PartRow, ...]:
    """The parts list, line by line as on the drawings and in the bill of materials."""
    from fluxbore.geometry.bill_of_materials import CARRIED
    from fluxbore.geometry.parts_list import parts_list
    from fluxbore.reports.content import PartRow

    rows = []
    for item in parts_list(parts, spec.materials):
        part, material = item.part, item.part.material or "envelope only"
        rows.append(
            PartRow(
                item.name,
                part.group,
                material,
                size_text(part),
                item.volume,
                item.mass,
                item.count,
                item.part_number,
                item.source,
                part.bought,
                item.number,
            )
        )
    if parts.carried_mass > 0:
        rows.append(PartRow(CARRIED, "mover", "", "", 0.0, parts.carried_mass))
    return tuple(rows)


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
    for count, words in (("elements", "quadratic triangles"), ("cells", "rectangles of fourth order")):
        if count in details:
            rows["mesh"] = (
                f"{details[count]:.0f} {words}, {details['unknowns']:.0f} unknowns, "
                f"refinement {spec.values['solver.mesh_refinement']}"
            )
    if command is not None:
        rows["command"] = "fluxbore " + " ".join(command)
    rows["date"] = datetime.now(UTC).strftime("%Y-%m-%d %H:%M UTC")
    return rows
