"""Hydraulic cylinders of random sizes: each drawn without overlap, as valid solids, or refused in one sentence; and the
PREHydrA's written as STEP and read back."""

from __future__ import annotations

from pathlib import Path

import ezdxf
import numpy as np
import pytest
from cad_files import assert_sound, read_tree, write_step

import fluxbore
from fluxbore.actuators import assembly_of
from fluxbore.design import graphics
from fluxbore.design.errors import DesignError
from fluxbore.design.spec import load, loads
from fluxbore.geometry import assembly as geometry
from fluxbore.geometry import part as parts_of
from fluxbore.geometry.drawing import dxf_document
from fluxbore.geometry.mass import envelope
from fluxbore.geometry.parts_list import parts_list
from fluxbore.geometry.solid import is_closed, kernel_volume, solid

pytestmark = [
    pytest.mark.full,
    pytest.mark.skipif(not graphics.has_gl(), reason=f"libGL is missing: {graphics.APT_LINE}"),
]

PREHYDRA = Path(__file__).parents[2] / "examples" / "prehydra.toml"
CYLINDER = "actuator.output_cylinder."
MM = 1e-3

RANGES = {
    CYLINDER + "stroke": (5.0, 400.0),
    CYLINDER + "wall_thickness": (0.2, 10.0),
    CYLINDER + "piston_length": (3.0, 50.0),
    CYLINDER + "cap_length": (5.0, 50.0),
    CYLINDER + "bleed_thread": (2.0, 10.0),
    "actuator.port.diameter": (1.0, 20.0),
    "actuator.seal.ring_section": (0.5, 7.0),
}
"""mm, drawn evenly in the logarithm."""


def random_values(rng: np.random.Generator) -> dict[str, str]:
    bore = float(np.exp(rng.uniform(*np.log((3.0, 100.0)))))
    values = {key: f"{np.exp(rng.uniform(*np.log(limits))):.6g} mm" for key, limits in RANGES.items()}
    return values | {
        CYLINDER + "bore": f"{bore:.6g} mm",
        CYLINDER + "rod_diameter": f"{bore * rng.uniform(0.1, 1.0):.6g} mm",
        "actuator.port.thread": str(rng.choice(["", "M5", "M8x1", "G1/8", "G1/4"])),
        CYLINDER + "mounting_thread": str(rng.choice(["", "M3", "M5"])),
        CYLINDER + "bush_wall": str(rng.choice(["0 mm", "0.5 mm", "1 mm"])),
        CYLINDER + "wiper_width": str(rng.choice(["0 mm", "2 mm"])),
        CYLINDER + "rated_pressure": f"{np.exp(rng.uniform(*np.log((1.0, 400.0)))):.4g} bar gauge",
        "actuator.input_cylinder.bore": "100 mm",
        "actuator.input_cylinder.stroke": "5 m",
    }


def test_random_cylinders_are_drawn_right_or_refused() -> None:
    """Overlaps by the outlines of all; of every tenth the kernel's solids and the drawing's audit too."""
    rng = np.random.default_rng(20)
    drawn, sentences = 0, []
    for _ in range(1000):
        values = random_values(rng)
        try:
            spec = load(PREHYDRA, values)
            whole = assembly_of(spec)
        except DesignError as error:
            sentences.append(str(error))
            continue
        drawn += 1
        assert geometry.interferences(whole) == (), values
        if drawn % 10:
            continue
        for part in whole.parts:
            body = solid(part)
            assert is_closed(body)
            assert kernel_volume(body) == pytest.approx(parts_of.volume(part), rel=1e-5), (part.name, values)
        assert not dxf_document(whole, spec.materials).audit().errors
    assert min(drawn, len(sentences)) > 100
    assert all(text.startswith("actuator.") and text.endswith(".") and "\n" not in text for text in sentences)


def test_step_files_come_back_whole_named_and_as_heavy(tmp_path: Path) -> None:
    spec = load(PREHYDRA, {CYLINDER + "material": "brass"})  # one of the program's own
    whole = assembly_of(spec)
    files = write_step(whole, tmp_path / "cad")
    assert len(files) == 1 + len(parts_list(whole, spec.materials))
    back = {piece.name: piece for piece in read_tree(files[0])[1]}
    assert set(back) == {part.name for part in whole.parts}
    for part in whole.parts:
        assert_sound(back[part.name].body, parts_of.volume(part), 1e-6)
        assert back[part.name].colour == pytest.approx(part.colour, abs=2e-3)
    bodies = {name: piece.body for name, piece in back.items()}
    assert max(body.BoundingBox().ylen for body in bodies.values()) * MM == pytest.approx(envelope(whole)[0], abs=1e-6)
    # The kernel's own overlap of neighbours, which the outlines say have none.
    for first, second in (("piston", "O-ring"), ("O-ring", "cylinder tube"), ("end cap, cap end", "bleed screw"),
                          ("piston", "rod"), ("end cap, rod end", "rod")):  # fmt: skip
        common = bodies[first].intersect(bodies[second])
        assert sum(kernel_volume(one) for one in common.Solids()) < 1e-15, (first, second)


def test_a_design_has_its_drawing_beside_its_step_files(tmp_path: Path) -> None:
    """The drawing is of the design that was found; that of another name does not stay beside it."""
    folder = tmp_path / "out"
    text = PREHYDRA.read_text(encoding="utf-8").partition("[study]")[0]
    for name, bore in (("PREHydrA", "14.3 mm"), ("narrow", "12 mm")):
        own = text.replace('name = "PREHydrA"', f'name = "{name}"')
        spec = loads(own, {CYLINDER + "bore": bore})
        found = fluxbore.design(spec, folder, picture=False, force=True)
        assert folder / "cad" / f"{name}.dxf" in found.files
        drawing = ezdxf.readfile(folder / "cad" / f"{name}.dxf")
        bores = [
            entity.get_measurement()
            for entity in drawing.modelspace().query("DIMENSION")
            if entity.get_xdata("FLUXBORE")[0].value == "bore"
        ]
        assert bores == [pytest.approx(float(bore.split()[0]))]
        assert {path.name.partition(".")[0].partition("-")[0] for path in (folder / "cad").iterdir()} == {
            "",
            name,
            "parts",
        }
