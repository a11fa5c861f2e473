"""Ports of small air cylinders: a thread and the narrower bore beneath it."""

from __future__ import annotations

from dataclasses import dataclass

from fluxbore.design.threads import MM, PORTS, Thread


@dataclass(frozen=True, slots=True)
class AirPort(Thread):
    """depth : of the thread. flow : diameter of the bore beneath (m).

    Both are a choice: room for the stud of usual fittings, and what such a fitting lets through.
    """

    depth: float = 0.0
    flow: float = 0.0


def _port(name: str, depth: float, flow: float) -> AirPort:
    """Depth and bore in mm."""
    thread = PORTS[name]
    return AirPort(
        thread.name,
        thread.diameter,
        thread.pitch,
        thread.core,
        thread.clearance,
        thread.stud,
        depth * MM,
        flow * MM,
    )


AIR_PORTS: dict[str, AirPort] = {
    port.name: port for port in (_port("M5", 6, 3), _port("G1/8", 8, 6), _port("G1/4", 11, 8))
}
"""By name."""
