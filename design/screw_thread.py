"""Threads that a drawing names by a word: ports of the air and fastening screws.

A thread is drawn as the cylinder of its core, D_1 = D - 1.0825 P: the inner diameter of the nut's thread by ISO 724 for
metric threads (sizes of ISO 261, coarse, which need no pitch in their name) and by ISO 228-1 for pipe threads (G).
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class ScrewThread:
    """name : as drawings write it. major, core : D and D_1. clearance : hole that the screw passes. Lengths in m."""

    name: str
    major: float
    core: float
    clearance: float


@dataclass(frozen=True, slots=True)
class PortThread:
    """name : as drawings write it. major, core : D and D_1. depth : of the thread. flow : bore beneath.
    Lengths in m.

    Depth and bore are a choice: room for the stud of usual fittings, and what such a fitting lets through.
    """

    name: str
    major: float
    core: float
    depth: float
    flow: float


_MM = 1e-3


def _screw(major: float, pitch: float, clearance: float) -> ScrewThread:
    """From millimetres; the clearance is ISO 273's medium series."""
    return ScrewThread(f"M{major:g}", major * _MM, (major - 1.0825 * pitch) * _MM, clearance * _MM)


SCREWS: dict[str, ScrewThread] = {
    thread.name: thread
    for thread in (
        _screw(1.6, 0.35, 1.8),
        _screw(2.0, 0.4, 2.4),
        _screw(2.5, 0.45, 2.9),
        _screw(3.0, 0.5, 3.4),
        _screw(4.0, 0.7, 4.5),
        _screw(5.0, 0.8, 5.5),
        _screw(6.0, 1.0, 6.6),
        _screw(8.0, 1.25, 9.0),
        _screw(10.0, 1.5, 11.0),
    )
}
"""By name."""

PORTS: dict[str, PortThread] = {
    "M5": PortThread("M5", 5.0 * _MM, 4.134 * _MM, 6.0 * _MM, 3.0 * _MM),
    "G1/8": PortThread("G1/8", 9.728 * _MM, 8.566 * _MM, 8.0 * _MM, 6.0 * _MM),
    "G1/4": PortThread("G1/4", 13.157 * _MM, 11.445 * _MM, 11.0 * _MM, 8.0 * _MM),
}
"""The ports of small air cylinders, by name."""
