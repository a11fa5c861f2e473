"""Draws one picture and ends: ``python -m fluxbore.reports.scene_child meshes.npz picture.png 1400 760``.

A process of its own, because a graphics driver that fails takes its process with it.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

FEATURE_ANGLE = 30.0
"""Degrees. Edges sharper than this are drawn and not smoothed over."""


def draw(source: Path, target: Path, size: tuple[int, int]) -> None:
    """Render the meshes of ``source`` (as `fluxbore.reports.scene` writes them) to a PNG with a transparent ground."""
    import pyvista

    with np.load(source, allow_pickle=False) as stored:
        arrays = dict(stored)
    count = sum(name.startswith("colour") for name in arrays)
    meshes = []
    for i in range(count):
        triangles = arrays[f"triangles{i}"]
        faces = np.hstack([np.full((len(triangles), 1), 3), triangles]).ravel()
        # Tessellations repeat the vertices of each face: joined, an edge is an edge and not the end of two sheets.
        meshes.append(pyvista.PolyData(arrays[f"vertices{i}"], faces).clean(tolerance=1e-7))
    points = np.vstack([mesh.points for mesh in meshes])
    low, high = points.min(axis=0), points.max(axis=0)
    centre, length = (low + high) / 2, float(high[2] - low[2])

    plotter = pyvista.Plotter(off_screen=True, window_size=list(size), lighting="none")
    for i, mesh in enumerate(meshes):
        look = {"ambient": 0.16, "diffuse": 0.8, "specular": 0.22, "specular_power": 18}
        plotter.add_mesh(
            mesh,
            color=arrays[f"colour{i}"],
            smooth_shading=True,
            split_sharp_edges=True,
            feature_angle=FEATURE_ANGLE,
            **look,
        )
        edges = mesh.extract_feature_edges(FEATURE_ANGLE, manifold_edges=False, non_manifold_edges=False)
        if edges.n_points:
            plotter.add_mesh(edges, color="#1b2530", line_width=1.4, lighting=False)
    # +z runs to the right, as in every figure of the report; the eye looks into the quarter +x +y that is cut away.
    towards = np.array([0.60, 0.80, 0.42])
    plotter.camera.focal_point = centre
    plotter.camera.position = centre + 2.4 * length * towards / np.linalg.norm(towards)
    plotter.camera.up = (1.0, 0.0, 0.0)
    plotter.camera.view_angle = 22.0
    for place, strength in (((1.4, 0.6, -0.4), 0.85), ((0.3, 1.3, 0.6), 0.5), ((0.3, -0.2, 1.5), 0.3)):
        light = pyvista.Light(position=centre + 3 * length * np.array(place), focal_point=centre, intensity=strength)
        light.positional = False
        plotter.add_light(light)
    plotter.enable_anti_aliasing("ssaa")
    _fill_frame(plotter.camera, points, size)
    plotter.screenshot(target, transparent_background=True)
    plotter.close()


def _fill_frame(camera: Any, points: NDArray[np.float64], size: tuple[int, int]) -> None:
    """Move the camera until the parts fill the frame but for a small margin; perspective needs a few rounds."""
    tangent = np.tan(np.radians(camera.view_angle) / 2)
    for _ in range(4):
        eye, focus, up = (np.asarray(v, dtype=float) for v in (camera.position, camera.focal_point, camera.up))
        ahead = (focus - eye) / np.linalg.norm(focus - eye)
        right = np.cross(ahead, up)
        right /= np.linalg.norm(right)
        above = np.cross(right, ahead)
        offset = points - eye
        depth = offset @ ahead
        x, y = offset @ right / depth / tangent * size[1] / size[0], offset @ above / depth / tangent
        shift = (x.max() + x.min()) / 2 * tangent * size[0] / size[1] * right + (
            y.max() + y.min()
        ) / 2 * tangent * above
        distance = np.linalg.norm(focus - eye)
        spread = max(float(np.ptp(x)), float(np.ptp(y))) / 2
        focus = focus + shift * distance
        camera.focal_point = focus
        camera.position = focus - ahead * distance * spread / 0.94
    camera.clipping_range = (0.01 * distance, 10 * distance)


if __name__ == "__main__":
    draw(Path(sys.argv[1]), Path(sys.argv[2]), (int(sys.argv[3]), int(sys.argv[4])))
