"""Solids of the CAD kernel: one valid closed body each, as large as arithmetic says, also beyond the prototype."""

import dataclasses
import math
from typing import Any

import pytest
from actuators import table_ii

from fluxbore.design import graphics
from fluxbore.design.errors import DesignError, MissingLibraryError
from fluxbore.design.hybrid import HybridActuator
from fluxbore.geometry import hybrid_parts, kernel, outline
from fluxbore.geometry import part as parts_of
from fluxbore.geometry import solid as solids
from fluxbore.geometry.outline import rectangle
from fluxbore.geometry.part import Hole, Part

MM = 1e-3

needs_gl = pytest.mark.skipif(not graphics.has_gl(), reason=f"libGL is missing: {graphics.APT_LINE}")


def variant(**sections: dict[str, Any]) -> HybridActuator:
    """The prototype with some values replaced, section by section."""
    actuator = table_ii()
    new: dict[str, Any] = {
        name: dataclasses.replace(getattr(actuator, name), **values) for name, values in sections.items()
    }
    return dataclasses.replace(actuator, **new)


def part(profile: outline.Profile, *holes: Hole) -> Part:
    return Part("block", "block", "stator", "steel", (0.5, 0.5, 0.5), profile, holes)


CASES = {
    "as published": table_ii(),
    "no rings, a port as wide as it may be": variant(
        mover={"ring_width": 0.0},
        end_caps={"port_diameter": 10.8 * MM, "flange_length": 14 * MM},
        shaft={"length": 240 * MM},
    ),
    "one pole pair, a narrow port, no clearance": variant(
        mover={"pole_pairs": 1}, end_caps={"port_diameter": 0.5 * MM, "rod_clearance": 0.0}
    ),
    "a fin that barely seals": variant(piston={"fin_outer_diameter": 16.11 * MM, "fin_thickness": 0.05 * MM}),
}


@needs_gl
@pytest.mark.parametrize("case", CASES)
def test_every_solid_is_valid_closed_and_as_large_as_arithmetic_says(case: str) -> None:
    """The two volumes share no code: Pappus and a quadrature against the kernel's own adaptive integration."""
    whole = hybrid_parts.assembly(CASES[case], CASES[case].mid_stroke)
    for one in whole.parts:
        if one.role == "coil" and one.name != "coil 02 V":
            continue
        body = solids.solid(one)
        assert len(body.Solids()) == 1
        assert body.isValid()
        assert solids.is_closed(body)
        assert solids.kernel_volume(body) == pytest.approx(parts_of.volume(one), rel=1e-6 if one.holes else 1e-9)
        low, high = min(z for _, z in one.profile), max(z for _, z in one.profile)
        box = body.BoundingBox()
        assert (box.zmin * MM, box.zmax * MM) == pytest.approx((low, high), abs=1e-6)


@needs_gl
def test_a_drilling_lies_where_it_was_put() -> None:
    """Height, angle and bottom by the centre of mass, which `test_assembly` has checked by hand."""
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps

    drilled = part(rectangle(0.004, 0.015, 0.0, 0.03), Hole(0.02, 0.006, 2.2, 0.007), Hole(0.006, 0.004, -0.4))
    body, properties = solids.solid(drilled), GProp_GProps()
    assert solids.kernel_volume(body) == pytest.approx(parts_of.volume(drilled), rel=1e-6)
    BRepGProp.VolumeProperties_s(body.wrapped, properties, 1e-9)
    centre = properties.CentreOfMass()
    found = (centre.X() * MM, centre.Y() * MM, centre.Z() * MM)
    assert found == pytest.approx(parts_of.centre_of_mass(drilled), abs=1e-8)


@needs_gl
def test_drillings_that_cut_a_part_in_two_are_refused() -> None:
    """Catches a compound of pieces passed on as if it were one part."""
    sawn = part(rectangle(0, 0.005, 0, 0.03), Hole(0.015, 0.012), Hole(0.015, 0.012, math.pi))
    with pytest.raises(DesignError, match="block must be one solid; its drillings leave 2"):
        solids.solid(sawn)


def test_without_libgl_the_sentence_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(kernel, "has_gl", lambda: False)
    monkeypatch.setattr(kernel.gl_stand_in, "load", lambda: False)
    with pytest.raises(MissingLibraryError, match=r"libGL\.so\.1.*apt-get install .*libgl1"):
        solids.solid(part(rectangle(0, 1, 0, 1)))


def test_without_cadquery_the_sentence_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(kernel, "has_gl", lambda: True)
    monkeypatch.setitem(__import__("sys").modules, "OCP.Message", None)
    with pytest.raises(MissingLibraryError, match="pip install cadquery"):
        solids.solid(part(rectangle(0, 1, 0, 1)))
