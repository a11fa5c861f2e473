"""A lead screw of a few hundred arcs, written and read back piece by piece."""

from __future__ import annotations

from pathlib import Path

import pytest

from fluxbore.actuators import assembly_of
from fluxbore.design import graphics
from fluxbore.design.spec import load
from fluxbore.geometry import assembly as geometry
from fluxbore.geometry import part as parts_of
from fluxbore.geometry import step
from fluxbore.geometry.solid import is_closed, kernel_volume

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
    paths = step.write_step(whole, tmp_path / "cad")
    root = cadquery.Assembly.importStep(str(paths[0]))
    back = [child for group in root.children for child in group.children]
    assert [child.name for child in back] == [part.name for part in whole.parts]
    for child, path, part in zip(back, paths[1:], whole.parts, strict=True):
        for body in (child.obj, cadquery.importers.importStep(str(path)).val()):
            assert len(body.Solids()) == 1
            assert body.isValid()
            assert is_closed(body)
            assert kernel_volume(body) == pytest.approx(parts_of.volume(part), rel=1e-6)
            centre = cadquery.Shape.centerOfMass(body)
            exact = parts_of.centre_of_mass(part)
            # The kernel's quick rule for centres is right to a few parts in ten thousand of a helix's radius.
            assert (centre.x * 1e-3, centre.y * 1e-3, centre.z * 1e-3) == pytest.approx(exact, abs=2e-5)
