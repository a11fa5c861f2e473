"""A lead screw of a few hundred arcs, written and read back piece by piece."""

from __future__ import annotations

from pathlib import Path

import pytest
from cad_files import assert_sound, read_tree, write_step

from fluxbore.actuators import assembly_of
from fluxbore.design import graphics
from fluxbore.design.spec import load
from fluxbore.geometry import assembly as geometry
from fluxbore.geometry import part as parts_of
from fluxbore.geometry.parts_list import parts_list

pytestmark = [
    pytest.mark.full,
    pytest.mark.skipif(not graphics.has_gl(), reason=f"libGL is missing: {graphics.APT_LINE}"),
]

ARCS = {
    f"actuator.{member}.{leaf}": value
    for member, form in (("translator", "stepped arcs"), ("rotor", "helical arcs"))
    for leaf, value in (("magnets", form), ("arc_angle", "59 deg"), ("arcs_per_turn", "6"))
}


@pytest.mark.parametrize("overrides", [{}, ARCS], ids=["continuous", "arcs"])
def test_every_piece_comes_back(tmp_path: Path, overrides: dict[str, str]) -> None:
    """All solids of the assembly's file, and each part's own: names, validity, volumes to 1e-6, centres."""
    import cadquery

    spec = load(Path(__file__).parents[2] / "examples" / "rotlin.toml", overrides)
    whole = assembly_of(spec)
    assert geometry.interferences(whole) == ()
    paths = write_step(whole, tmp_path / "cad")
    _, pieces = read_tree(paths[0])
    assert [piece.name for piece in pieces] == [part.name for part in whole.parts]
    for piece, part in zip(pieces, whole.parts, strict=True):
        assert_sound(piece.body, parts_of.volume(part), 1e-6)
        centre = cadquery.Shape.centerOfMass(piece.body)
        exact = parts_of.centre_of_mass(part)
        # The kernel's quick rule for centres is right to a few parts in ten thousand of a helix's radius.
        assert (centre.x * 1e-3, centre.y * 1e-3, centre.z * 1e-3) == pytest.approx(exact, abs=2e-5)
    items = parts_list(whole, spec.materials)
    for path, item in zip(paths[1:], items, strict=True):
        assert_sound(cadquery.importers.importStep(str(path)).val(), item.volume, 1e-6)
