"""Pictures of solved models: what is in the window, which lines are drawn, and files that are small and alike."""

import base64
import io
import re
import sys
import xml.etree.ElementTree as ET
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

sys.path.insert(0, str(Path(__file__).parents[2] / "docs" / "validation"))

from cases.drawing import Drawing

from fluxbore.design.errors import OutputError, SpecError
from fluxbore.fem.femm_solution import FemmSolution, solve_model
from fluxbore.reports.flux_plot import flux_plot, picture
from fluxbore.reports.flux_sample import Sampled, colour_limit, field_lines, interesting, sampled, whole

MM = 1e-3
B_X, B_Z = 0.3, 0.4


@cache
def coil() -> FemmSolution:
    """A coil 2 mm wide and 4 mm high at r = 3 mm in a ball of 60 mm of air."""
    drawing = Drawing(axisymmetric=True)
    drawing.half_disc(60, boundary=drawing.boundary("far"))
    drawing.rectangle((3, 5), (-2, 2))
    drawing.label(4, 0, drawing.material("$<1>$\a 鉄"), drawing.circuit("U & V", 3.0), turns=-70)
    drawing.label(20, 0, drawing.material("air"))
    return solve_model(drawing.model(), accuracy=0.02)


@cache
def square() -> FemmSolution:
    """Two inches by two of air in a field along x, in a file of inches."""
    drawing = Drawing(axisymmetric=False, unit="inches")
    edge = drawing.boundary("far", a2=B_X * 25.4 * MM)
    drawing.rectangle((-1, 1), (-1, 1), edge)
    drawing.label(0, 0, drawing.material("air"))
    return solve_model(drawing.model())


@cache
def strip() -> FemmSolution:
    """A sheet of current 100 times as long as it is thick."""
    drawing = Drawing(axisymmetric=False)
    drawing.line((0, 0), (0, 1), boundary=drawing.boundary("A=0"))
    drawing.line((0, 0), (100, 0), (100, 1), (0, 1))
    drawing.label(50, 0.5, drawing.material("copper", density=1e6))
    return solve_model(drawing.model())


def test_the_window_is_what_is_not_air() -> None:
    """Catches a coil that is a speck in the middle of its air, and an axis that is cut off."""
    assert interesting(coil()) == pytest.approx((0, 6.2 * MM, -3.2 * MM, 3.2 * MM))
    assert whole(coil()) == pytest.approx((0, 60 * MM, -60 * MM, 60 * MM))


def test_a_window_of_nothing_but_air_is_the_model() -> None:
    """Catches an empty window."""
    assert interesting(square()) == whole(square()) == pytest.approx(tuple(25.4 * MM * n for n in (-1, 1, -1, 1)))


def test_field_lines_of_a_uniform_field() -> None:
    """Catches a level on the rim or the axis, and lines that are cut into pieces or lie elsewhere."""
    lines = field_lines(sampled(square(), whole(square())), 20)
    assert len(lines) == 20
    heights = [float(line[:, 1].mean()) / (25.4 * MM) for line in lines]
    assert sorted(heights) == pytest.approx([-1 + (i + 0.5) / 10 for i in range(20)], abs=1e-6)
    for line in lines:
        assert np.ptp(line[:, 0]) == pytest.approx(2 * 25.4 * MM)
        assert np.ptp(line[:, 1]) < 1e-8
    assert field_lines(sampled(square(), whole(square())), 0) == []


def test_field_lines_are_level_lines() -> None:
    """Catches r A taken for A, and lines of a cut element that stray from the field's own."""
    field = sampled(coil(), interesting(coil()))
    low, high = field.potential.min(), field.potential.max()
    found = set()
    for line in field_lines(field, 10):
        levels = (coil().probe(line / MM).potential - low) / (high - low) * 10 - 0.5
        assert levels == pytest.approx(np.full(levels.size, round(levels.mean())), abs=0.02)
        found.add(round(levels.mean()))
    assert found == set(range(10))


def test_colours_leave_corners_out() -> None:
    """Catches a scale that a singular corner stretches, and a small block that a large one hides."""
    side = np.arange(101) / 100
    x, y = (grid.ravel() for grid in np.meshgrid(side, side))
    cell = np.arange(100)[:, None] * 101 + np.arange(100)
    triangles = np.stack([cell, cell + 1, cell + 101], -1).reshape(-1, 3)
    region = np.where(np.arange(triangles.shape[0]) == 5000, 1, 0)
    density = np.ones(x.size)
    density[0] = 1e6  # a corner
    field = Sampled(np.column_stack((x, y)), triangles, region, density, x)
    assert colour_limit(field) == pytest.approx(1.0)
    density[triangles[5000]] = 2.0
    assert colour_limit(field) == pytest.approx(2.0)
    assert colour_limit(Sampled(field.points, triangles, region, 0 * density, x)) > 0


def test_an_svg_is_small_and_says_what_it_shows(tmp_path: Path) -> None:
    """Catches a field of vectors, names that break the XML, become formulas or warn, and lengths without a unit."""
    path = flux_plot(coil(), tmp_path / "coil.svg", names=True)
    text = path.read_text()
    assert len(text) < 1_000_000
    root = ET.fromstring(text)
    words = ["".join(item.itertext()).strip() for item in root.iter("{http://www.w3.org/2000/svg}text")]
    for expected in ("r (mm)", "z (mm)", "|B| (T)"):
        assert expected in words
    assert any(r"$<1>$\x07 鉄" in word for word in words)
    assert any("U & V: -70" in word for word in words)
    assert "x (in)" in picture(square(), "svg").decode()
    assert len(re.findall("<image", text)) == 2  # the field and the bar's colours


def test_the_same_solution_is_the_same_picture() -> None:
    """Catches a date or random identifiers in the file."""
    assert picture(strip(), "svg") == picture(strip(), "svg")


def test_the_colour_of_a_uniform_field() -> None:
    """Catches holes between elements, and colours that do not follow |B|."""
    svg = picture(square(), "svg", lines=0).decode()
    images = [base64.b64decode(data) for data in re.findall(r"data:image/png;base64,([^\"]+)", svg)]
    images.sort(key=lambda data: np.prod(Image.open(io.BytesIO(data)).size))
    field = np.asarray(Image.open(io.BytesIO(images[-1])).convert("RGBA")).astype(int)
    middle = field[20:-20, 20:-20]
    assert np.all(middle[..., 3] == 255)
    assert np.ptp(middle[..., :3], axis=(0, 1)).max() <= 3


@pytest.mark.parametrize("build", [coil, strip])
def test_pictures_have_the_width_that_is_asked_for(build: type) -> None:
    """Catches a thin model that makes a picture of no height, or an axes squeezed to nothing."""
    image = Image.open(io.BytesIO(picture(build(), "png", width=600)))
    assert image.width == pytest.approx(600, abs=3)
    assert 120 < image.height < 1200
    colours = np.asarray(image.convert("RGB")).astype(int)
    assert np.mean(np.ptp(colours, axis=-1) > 20) > 0.02  # some of it is the field


@pytest.mark.parametrize("name", ["field.pdf", "field", "field.png.txt"])
def test_a_name_of_another_kind(tmp_path: Path, name: str) -> None:
    """Catches a traceback of matplotlib's."""
    with pytest.raises(OutputError, match=r"must end in \.svg or \.png"):
        flux_plot(strip(), tmp_path / name)
    assert not list(tmp_path.iterdir())


def test_a_folder_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="cannot be written"):
        flux_plot(strip(), tmp_path / "nowhere" / "field.png")


@pytest.mark.parametrize("options", [{"width": 20}, {"width": 10**6}, {"lines": -1}, {"lines": 10**6}])
def test_pictures_out_of_range(options: dict[str, int]) -> None:
    """Catches a figure without room, and one that fills the memory."""
    with pytest.raises(SpecError, match="of a picture must be from"):
        picture(strip(), "png", **options)
