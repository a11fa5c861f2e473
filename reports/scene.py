"""A rendered picture of the actuator, drawn off the screen in a process of its own.

VTK does not raise where there is no graphics driver: it ends the process. So the driver is asked for first, the drawing
runs in a child with a time limit, and whatever happens to the child becomes a reason on the page.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from fluxbore.design import graphics
from fluxbore.reports.content import Picture

Mesh = tuple[str, tuple[float, float, float], NDArray[np.floating], NDArray[np.integer]]
"""Name, colour (sRGB, 0 to 1), vertices (n, 3) in m, triangles (m, 3) of one part."""

SIZE = (1400, 620)
"""Pixels; twice what the first screen shows, for print and for dense displays."""

TIME_LIMIT = 90.0
"""s. A software driver draws fifty parts in two or three."""


def render_picture(
    meshes: Sequence[Mesh], path: Path | None = None, size: tuple[int, int] = SIZE, time_limit: float = TIME_LIMIT
) -> Picture:
    """The parts in perspective on a transparent ground, or the reason why there is no picture. Never raises for want of
    graphics.

    meshes : tessellated parts, the axis along z; cut-aways are the caller's, and one of which nothing is left is not
    drawn. path : where to keep a copy, if anywhere.
    """
    meshes = [mesh for mesh in meshes if len(mesh[3])]
    if not meshes:
        return Picture(None, "There is no solid model to draw.")
    if not graphics.has_egl():
        return Picture(
            None, f"No rendered picture: the graphics libraries are missing. Install them by: {graphics.APT_LINE}"
        )
    with tempfile.TemporaryDirectory(prefix="fluxbore-picture-") as folder:
        source, target = Path(folder) / "meshes.npz", Path(folder) / "picture.png"
        np.savez(source, **_arrays(meshes))  # type: ignore[arg-type]
        width, height = map(str, size)
        command = [sys.executable, "-m", "fluxbore.reports.scene_child", str(source), str(target), width, height]
        try:
            done = subprocess.run(
                command, stdin=subprocess.DEVNULL, capture_output=True, timeout=time_limit, check=False
            )
        except subprocess.TimeoutExpired:
            return Picture(None, f"No rendered picture: drawing took longer than {time_limit:.0f} s.")
        except OSError as error:
            return Picture(None, f"No rendered picture: {error.strerror or error}.")
        if done.returncode != 0 or not target.is_file():
            return Picture(None, f"No rendered picture: the drawing process ended with status {done.returncode}.")
        png = target.read_bytes()
    if path is not None:
        path.write_bytes(png)
    return Picture(png)


def _arrays(meshes: Sequence[Mesh]) -> dict[str, NDArray[np.generic]]:
    """Arrays only, so that the child unpickles nothing."""
    found: dict[str, NDArray[np.generic]] = {}
    for i, (_, colour, vertices, triangles) in enumerate(meshes):
        found[f"colour{i}"] = np.asarray(colour, dtype=float)
        found[f"vertices{i}"] = np.asarray(vertices, dtype=float)
        found[f"triangles{i}"] = np.asarray(triangles, dtype=np.int64)
    return found
