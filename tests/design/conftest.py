"""The actuator of the paper, and the standard materials, for every test of this room."""

import pytest

from fluxbore.design.hybrid import BackYoke, Cylinder, EndCaps, HybridActuator, Mover, Piston, Shaft, Winding
from fluxbore.design.materials import Library, standard


@pytest.fixture(scope="session")
def table_ii() -> HybridActuator:
    """Nakata and Noda (2023), Tables II and III; lengths that they do not give are plausible."""
    mm = 1e-3
    return HybridActuator(
        name="iPEHLA",
        back_yoke=BackYoke(27 * mm, 25 * mm, 3 * mm, 10 * mm, "1010"),
        winding=Winding(24.2 * mm, 8, 584, 0.4 * mm, "copper"),
        cylinder=Cylinder(20 * mm, 16.1 * mm, 16 * mm, 220 * mm, "aluminium 6061"),
        mover=Mover(12 * mm, 1.5 * mm, 4, 15.9 * mm, "N48", 1.4, 1.05, "1010", 88 * mm),
        shaft=Shaft(8 * mm, 235 * mm, "stainless steel 304"),
        piston=Piston(8 * mm, 16.3 * mm, 15.4 * mm, 1.8 * mm, 0.3 * mm, "POM"),
        end_caps=EndCaps(30 * mm, 15 * mm, 5 * mm, 0.1 * mm, "aluminium 6061"),
    )


@pytest.fixture(scope="session")
def library() -> Library:
    return standard()
