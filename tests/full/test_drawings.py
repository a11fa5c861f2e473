"""Drawings of random designs: legible, complete and free of errors, whatever the sizes."""

from __future__ import annotations

import io
from pathlib import Path

import ezdxf
import numpy as np
import pytest
from drawing_checks import check_texts, check_told, read_back, told

from fluxbore.actuators import assembly_of
from fluxbore.design.errors import DesignError
from fluxbore.design.spec import Spec, load
from fluxbore.geometry.drawing_set import drawing_set, made
from fluxbore.geometry.part import Part
from fluxbore.geometry.parts_list import parts_list
from fluxbore.geometry.sheet_dxf import dxf_text

pytestmark = pytest.mark.full

EXAMPLES = Path(__file__).parents[2] / "examples"

RANGES = {
    "ipehla": {
        "actuator.mover.ring_width": (0.1, 6.0),
        "actuator.back_yoke.thickness": (0.3, 4.0),
        "actuator.piston.length": (4.0, 20.0),
        "actuator.end_caps.flange_length": (8.0, 30.0),
        "actuator.shaft.length": (225.0, 400.0),
    },
    "prehydra": {
        "actuator.output_cylinder.stroke": (5.0, 400.0),
        "actuator.output_cylinder.wall_thickness": (0.2, 10.0),
        "actuator.output_cylinder.piston_length": (3.0, 50.0),
        "actuator.output_cylinder.cap_length": (5.0, 50.0),
        "actuator.output_cylinder.bore": (5.0, 80.0),
    },
}
"""mm, drawn evenly in the logarithm."""


@pytest.mark.parametrize("name", list(RANGES))
def test_random_designs_are_drawn_legibly_and_whole(name: str) -> None:
    rng = np.random.default_rng(30)
    drawn = tried = 0
    while drawn < 20:
        tried += 1
        assert tried < 1000
        values = {key: f"{np.exp(rng.uniform(*np.log(limits))):.6g} mm" for key, limits in RANGES[name].items()}
        try:
            spec = load(EXAMPLES / f"{name}.toml", values)
            check_drawings(spec, read=drawn % 10 == 0)
        except DesignError:
            continue
        drawn += 1


@pytest.mark.parametrize("name", ["ipehla", "ipehla-optimum", "prehydra", "rotlin", "team22", "fabry"])
def test_every_sheet_of_the_examples_is_read_back(name: str) -> None:
    check_drawings(load(EXAMPLES / f"{name}.toml"), read=True)


def check_drawings(spec: Spec, *, read: bool) -> None:
    """All sheets; read : by another reader of DXF too."""
    whole = assembly_of(spec)
    items = parts_list(whole, spec.materials)
    first, parts = drawing_set(whole, items)
    for sheet in (*first, *parts):
        check_texts(sheet)
    for item, sheet in zip([item for item in items if made(item)], parts, strict=True):
        sizes = told(sheet)
        if read:
            document = ezdxf.read(io.StringIO(dxf_text(sheet)))
            assert not document.audit().errors
            again = read_back(document)
            assert {key: size for key, (_, size) in again.items()} == pytest.approx(
                {key: size for key, (_, size) in sizes.items()}, rel=1e-9
            )
            sizes = again
        if isinstance(item.part, Part):
            check_told(item.part, sizes)
