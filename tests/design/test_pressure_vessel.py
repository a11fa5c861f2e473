"""The cylinder under pressure, against the equilibrium of the wall integrated step by step and against thin walls."""

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_bvp

from fluxbore.design.hybrid import HybridActuator
from fluxbore.design.materials import Library
from fluxbore.design.pressure_vessel import displacement, vessel, wall_stress

E, NU = 68.9e9, 0.33


@pytest.mark.parametrize("closed", [True, False])
@pytest.mark.parametrize(("inside", "outside"), [(0.6e6, 0.0), (-0.1e6, 0.0), (0.0, 0.3e6)])
def test_the_wall_is_in_equilibrium(inside: float, outside: float, closed: bool) -> None:
    """Catches a wrong sign or term in Lame's solution or in Hooke's law: (r s_r)' = s_t, u' and u/r are the strains."""
    a, b = 8.05e-3, 10e-3
    axial = (inside * a**2 - outside * b**2) / (b**2 - a**2) if closed else 0.0

    def hoop(r, u, radial):
        return E * u / r + NU * (radial + axial)

    def slopes(r, y):
        u, radial = y
        return [(radial - NU * (hoop(r, u, radial) + axial)) / E, (hoop(r, u, radial) - radial) / r]

    grid = [a + (b - a) * i / 20 for i in range(21)]
    solved = solve_bvp(
        slopes, lambda p, q: [p[1] + inside, q[1] + outside], grid, [[1e-9] * 21, [-inside] * 21], tol=1e-9
    )
    for r in (a, (a + b) / 2, b):
        u, radial = solved.sol(r)
        stress = wall_stress(r, a, b, inside, outside=outside, closed=closed)
        assert stress.radial == pytest.approx(radial, rel=1e-6, abs=1.0)
        assert stress.hoop == pytest.approx(hoop(r, u, radial), rel=1e-6, abs=1.0)
        assert stress.axial == axial
        assert displacement(r, a, b, inside, E, NU, outside=outside, closed=closed) == pytest.approx(u, rel=1e-6)


@given(pressure=st.floats(1e3, 1e8), radius=st.floats(1e-3, 1.0))
def test_a_thin_wall_is_barlows(pressure: float, radius: float) -> None:
    """Catches a slip that the limit shows: s_t = p r/t, closed ends s_z = p r/(2 t), u = p r^2/(E t) (1 - nu/2)."""
    wall = 1e-5 * radius
    stress = wall_stress(radius, radius, radius + wall, pressure)
    assert stress.hoop == pytest.approx(pressure * radius / wall, rel=1e-4)
    assert stress.axial == pytest.approx(stress.hoop / 2, rel=1e-4)
    moved = displacement(radius, radius, radius + wall, pressure, E, NU)
    assert moved == pytest.approx(pressure * radius**2 / (E * wall) * (1 - NU / 2), rel=1e-4)


@given(inner=st.floats(1e-3, 0.1), ratio=st.floats(1.01, 10), pressure=st.floats(1e3, 1e8))
def test_the_hoop_carries_the_pressure(inner: float, ratio: float, pressure: float) -> None:
    """Catches a wall that does not hold what pushes the two halves apart: integral of s_t dr = p a."""
    outer, n = inner * ratio, 4000
    step = (outer - inner) / n
    carried = sum(wall_stress(inner + (i + 0.5) * step, inner, outer, pressure).hoop for i in range(n)) * step
    assert carried == pytest.approx(pressure * inner, rel=1e-4)


def test_equal_pressure_inside_and_outside_squeezes_evenly() -> None:
    stress = wall_stress(9e-3, 8e-3, 10e-3, 1e6, outside=1e6)
    assert stress.radial == stress.hoop == pytest.approx(stress.axial) == pytest.approx(-1e6)
    assert stress.equivalent == pytest.approx(0, abs=1e-3)


def test_the_prototypes_cylinder(table_ii: HybridActuator, library: Library) -> None:
    """At the paper's 0.6 MPa: 2.81 MPa by (b^2 + a^2)/(b^2 - a^2) p; the bore opens by a third of a micrometre."""
    found = vessel(table_ii.cylinder, library["aluminium 6061"], 0.6e6)
    assert found.hoop_stress == pytest.approx(0.6e6 * (10**2 + 8.05**2) / (10**2 - 8.05**2))
    assert found.hoop_stress == pytest.approx(2.81e6, rel=1e-3)
    # Closed ends at the bore: sqrt(3) p b^2/(b^2 - a^2).
    assert found.safety == pytest.approx(276e6 / (3**0.5 * 0.6e6 * 100 / (100 - 8.05**2)))
    assert found.dilation is not None
    assert 0.2e-6 < found.dilation < 0.4e-6
    sucked = vessel(table_ii.cylinder, library["aluminium 6061"], -0.1e6)
    assert sucked.dilation is not None
    assert sucked.dilation < 0
    freed = vessel(table_ii.cylinder, library["aluminium 6061"], 0.6e6, closed=False)
    assert freed.dilation is not None
    assert freed.dilation > found.dilation


def test_what_the_material_does_not_tell_is_not_given(table_ii: HybridActuator, library: Library) -> None:
    """Catches a guessed modulus or strength: brass states neither Poisson's ratio nor yield stress."""
    found = vessel(table_ii.cylinder, library["brass"], 0.6e6)
    assert found.hoop_stress > 0
    assert found.safety is None
    assert found.dilation is None
    assert vessel(replace(table_ii.cylinder), library["aluminium 6061"], 0.0).safety is None
