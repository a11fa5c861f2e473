"""The lines of a hatch, for formats that have no hatch of their own."""

from __future__ import annotations

import math
from functools import lru_cache

from fluxbore.geometry.sheet import Hatch, Place


@lru_cache(maxsize=512)  # a sheet is written in several formats
def hatch_lines(hatch: Hatch) -> tuple[tuple[Place, Place], ...]:
    """Parallel lines (mm) at the hatch's angle and spacing within its outline and outside its holes.

    They lie on one grid through the sheet's corner, so that both halves of a part are hatched alike.
    """
    import shapely
    from shapely import affinity

    area = shapely.Polygon(hatch.rings[0], hatch.rings[1:])
    level = affinity.rotate(area, -hatch.angle, origin=(0, 0))
    left, low, right, high = level.bounds
    first, last = math.ceil(low / hatch.spacing), math.floor(high / hatch.spacing)
    rows = [((left - 1, i * hatch.spacing), (right + 1, i * hatch.spacing)) for i in range(first, last + 1)]
    if not rows:
        return ()
    cut = affinity.rotate(shapely.MultiLineString(rows).intersection(level), hatch.angle, origin=(0, 0))
    found = []
    for line in getattr(cut, "geoms", (cut,)):
        if line.geom_type == "LineString" and not line.is_empty:
            (x0, y0), (x1, y1) = line.coords[0], line.coords[-1]
            found.append(((x0, y0), (x1, y1)))
    return tuple(found)
