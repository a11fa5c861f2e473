"""Threads of ports and fasteners: nominal and core diameters by ISO 724 and ISO 228-1.

Of a metric thread the core is D_1 = D - 1.0825 P (ISO 724, fundamental triangle 5/8 H), of a pipe thread the standard's
own minor diameter. Lengths in metres.
"""

from __future__ import annotations

from dataclasses import dataclass

CORE = 1.082531754730548
"""5/8 sqrt(3): what an internal metric thread's core is smaller than its nominal diameter, in pitches."""

MM = 1e-3


@dataclass(frozen=True, slots=True)
class Thread:
    """name : as drawings write it. diameter : nominal, core : of the internal thread, pitch, clearance : of the hole
    that lets its screw through (ISO 273, medium; 0 of what no screw has), stud : how far connectors screw in (m)."""

    name: str
    diameter: float
    pitch: float
    core: float
    clearance: float = 0.0
    stud: float = 0.0

    def tapped(self, depth: float) -> str:
        """As a drawing writes a tapped hole of this depth (m): "M5 x 6"."""
        return f"{self.name} x {round(depth / MM, 2):g}"


def _metric(diameter: float, pitch: float, clearance: float = 0.0, stud: float = 0.0, fine: bool = False) -> Thread:
    """Sizes in mm. ISO 261: coarse unless `fine`, whose names tell the pitch."""
    name = f"M{diameter:g}x{pitch:g}" if fine else f"M{diameter:g}"
    return Thread(name, diameter * MM, pitch * MM, (diameter - CORE * pitch) * MM, clearance * MM, stud * MM)


def _pipe(size: str, diameter: float, pitch: float, core: float, stud: float) -> Thread:
    """ISO 228-1, parallel; sizes in mm."""
    return Thread(f"G{size}", diameter * MM, pitch * MM, core * MM, stud=stud * MM)


SCREWS: dict[str, Thread] = {
    thread.name: thread
    for thread in (
        _metric(1.6, 0.35, 1.8),
        _metric(2, 0.4, 2.4),
        _metric(2.5, 0.45, 2.9),
        _metric(3, 0.5, 3.4),
        _metric(4, 0.7, 4.5),
        _metric(5, 0.8, 5.5),
        _metric(6, 1.0, 6.6),
        _metric(8, 1.25, 9.0),
        _metric(10, 1.5, 11.0),
        _metric(12, 1.75, 13.5),
    )
}
"""Of fasteners, by name."""

PORTS: dict[str, Thread] = {
    thread.name: thread
    for thread in (
        _metric(5, 0.8, stud=4.5),
        _metric(8, 1.0, stud=8.0, fine=True),
        _metric(10, 1.0, stud=8.0, fine=True),
        _pipe("1/8", 9.728, 0.907, 8.566, 8.0),
        _pipe("1/4", 13.157, 1.337, 11.445, 12.0),
    )
}
"""Of connectors, by name; studs as long as those of ISO 1179-2 (G), ISO 6149-2 and makers' lists (M5) are."""
