"""The actuator of the paper, and the standard materials, for every test of this room."""

import pytest
from actuators import table_ii

from fluxbore.design.hybrid import HybridActuator
from fluxbore.design.materials import Library, standard


@pytest.fixture(scope="session", name="table_ii")
def _table_ii() -> HybridActuator:
    return table_ii()


@pytest.fixture(scope="session")
def library() -> Library:
    return standard()
