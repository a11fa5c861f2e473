"""The rendered picture: a value in every case, and never the death of the program."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from fluxbore.design import graphics
from fluxbore.reports.scene import Mesh, render_picture


def a_tube() -> Mesh:
    angles = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    ring = np.stack([np.cos(angles), np.sin(angles), np.zeros(24)], axis=1) * 0.01
    vertices = np.concatenate([ring, ring + [0, 0, 0.1]])
    i, j = np.arange(24), (np.arange(24) + 1) % 24
    triangles = np.concatenate([np.stack([i, j, j + 24], 1), np.stack([i, j + 24, i + 24], 1)])
    return "tube", (0.2, 0.4, 0.7), vertices, triangles


@pytest.mark.skipif(not graphics.has_egl(), reason="needs EGL")
def test_a_picture_shows_the_part_on_a_transparent_ground(tmp_path: Path) -> None:
    """Catches an empty frame, a part outside of it, and an opaque ground."""
    import io

    from PIL import Image

    picture = render_picture([a_tube()], tmp_path / "copy.png", size=(280, 124))
    assert picture.png is not None, picture.reason
    assert (tmp_path / "copy.png").read_bytes() == picture.png
    with Image.open(io.BytesIO(picture.png)) as image:
        assert image.size == (280, 124)
        alpha = np.asarray(image.convert("RGBA"))[:, :, 3]
    assert alpha[0, 0] == 0
    assert 0.03 < (alpha > 128).mean() < 0.9
    columns = np.flatnonzero((alpha > 128).any(axis=0))
    assert columns[0] < 30
    assert columns[-1] > 250


def test_without_graphics_the_reason_names_the_packages(monkeypatch: pytest.MonkeyPatch) -> None:
    """Catches a crash, or a silent gap, on a machine without graphics libraries."""
    monkeypatch.setattr(graphics, "has_egl", lambda: False)
    picture = render_picture([a_tube()])
    assert picture.png is None
    assert graphics.APT_LINE in picture.reason


def test_a_drawing_that_dies_or_hangs_is_a_reason(monkeypatch: pytest.MonkeyPatch) -> None:
    """Catches an exception where the child process fails: the report goes on without the picture."""
    monkeypatch.setattr(graphics, "has_egl", lambda: True)
    assert "longer than" in render_picture([a_tube()], time_limit=0.01).reason
    broken: Mesh = ("broken", (0, 0, 0), np.zeros((3, 2)), np.zeros((1, 3), dtype=int))
    assert "ended with status" in render_picture([broken]).reason
    assert render_picture([]).reason
