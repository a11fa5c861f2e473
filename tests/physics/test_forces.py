"""Force of the motor by independent routes: stress tensor, virtual work, flux linkage, symmetry."""

from collections.abc import Callable, Sequence
from dataclasses import replace

import cell_energy
import numpy as np
import pytest

from fluxbore.design.spec import Spec
from fluxbore.fem.cell_system import CellSystem
from fluxbore.fem.magnetostatics import Settings
from fluxbore.fem.tubular import TubularSolution, solve_currents, solve_grid, solve_positions
from fluxbore.geometry.hybrid import cross_section

MU_0 = 4e-7 * np.pi
Motor = Callable[..., list[TubularSolution]]


def energy(item: TubularSolution) -> float:
    """∫ w(B) dV − (loads · ψ) (J), which the field makes stationary."""
    system = item.solution.system
    assert isinstance(system, CellSystem)
    return 2 * np.pi * cell_energy.energy(system, item.solution.psi)


def with_currents(item: TubularSolution, currents: Sequence[float]) -> TubularSolution:
    """The same position with currents (A) in the phases."""
    phases = [circuit.name for circuit in item.solution.problem.circuits]
    loaded = dict(zip(phases, currents, strict=True))
    found = solve_currents(item.section, item.position, loaded, Settings(tolerance=1e-10), near=item)
    assert found.convergence.converged
    return found


def test_stress_tensor_is_the_derivative_of_the_discrete_energy(motor: Motor) -> None:
    """Catches any error of the stress integral: nodes inside the shell shifted, ψ kept, the energy's own difference.

    The field makes the energy stationary, so ψ need not be solved again. What is inside of the shell is shifted as a
    whole, and within it the cells are sheared: ∂ψ/∂s falls by the shear times ∂ψ/∂z.
    """
    (item,) = motor([0.0885])
    cells = item.cells
    inner, outer = (r**2 / 2 for r in item.section.force_annulus)
    line = np.arange(cells.region.size) % cells.shape[1]
    shell = (line >= item.grid.line(item.section.force_annulus[0])) & (
        line < item.grid.line(item.section.force_annulus[1])
    )
    assert np.sum(cells.weight[shell]) == pytest.approx((outer - inner) * np.ptp(item.grid.z_lines))
    across, along = cells.fields(item.solution.psi)
    rise = along / cells.inverse_radius

    def sheared(by: float) -> float:
        b_z = across + by / (outer - inner) * rise
        return float(np.pi / MU_0 * np.sum((cells.weight * (b_z**2 + along**2))[shell]))

    step = 2e-6
    force = -(sheared(step) - sheared(-step)) / (2 * step)
    assert abs(force) > 0.05
    assert item.cogging_force() == pytest.approx(force, rel=1e-6)


def test_thrust_is_the_change_of_energy_with_position(motor: Motor) -> None:
    """Catches a wrong thrust constant by virtual work: energies of two positions at ±2 A, cogging falling out."""
    step, amperes, z = 2e-4, 2.0, 0.0262
    behind, here, ahead = motor([z - step, z, z + step])
    thrust = here.thrust_constants()
    for phase in range(3):
        drive = amperes * np.eye(3)[phase]
        forces = [
            -(energy(with_currents(ahead, sign * drive)) - energy(with_currents(behind, sign * drive))) / (2 * step)
            for sign in (1, -1)
        ]
        constant = (forces[0] - forces[1]) / (2 * amperes)
        assert constant == pytest.approx(thrust[phase], abs=3e-3 * np.abs(thrust).max())


def test_thrust_is_the_change_of_linkage_with_position(motor: Motor) -> None:
    """Catches a thrust constant that is not ∂λ/∂z, which energy demands: within the mesh's error, 0.2 %."""
    step, z = 2e-4, 0.0262
    behind, here, ahead = motor([z - step, z, z + step])
    slope = (ahead.flux_linkages() - behind.flux_linkages()) / (2 * step)
    assert here.thrust_constants() == pytest.approx(slope, abs=2e-3 * np.abs(slope).max())


def test_incremental_thrust_is_the_force_of_a_small_current(motor: Motor) -> None:
    """Catches an adjoint at the wrong state: against two full solutions at ±0.1 A, to the current's square."""
    (item,) = motor([0.0262])
    thrust = item.thrust_constants()
    for phase in range(3):
        drive = 0.1 * np.eye(3)[phase]
        forces = [with_currents(item, sign * drive).cogging_force() for sign in (1, -1)]
        assert (forces[0] - forces[1]) / 0.2 == pytest.approx(thrust[phase], abs=2e-6 * np.abs(thrust).max())


def test_incremental_thrust_under_load_is_the_slope_of_the_force(motor: Motor) -> None:
    """Catches a thrust constant that forgets saturation: at 20 A it is the local slope, and not the one at rest."""
    (item,) = motor([0.0262])
    drive = np.array([20.0, -10.0, -10.0])
    loaded = with_currents(item, drive)
    here = loaded.thrust_constants()
    nudge = np.array([0.05, 0.0, 0.0])
    ahead, behind = (with_currents(item, drive + sign * nudge).cogging_force() for sign in (1, -1))
    slope = (ahead - behind) / 0.1
    assert here[0] == pytest.approx(slope, rel=1e-4)
    assert abs(here[0] - item.thrust_constants()[0]) > 1e-4 * abs(here[0])


def test_phases_couple_equally_both_ways(motor: Motor) -> None:
    """Catches an inductance matrix that is not symmetric: incremental, in the saturated yoke, with iron."""
    (item,) = motor([0.0262])
    solution = item.solution
    loads = np.array([circuit.density for circuit in solution.problem.circuits])
    inductance = 2 * np.pi * loads @ np.array([solution.response(load) for load in loads]).T
    np.testing.assert_allclose(inductance, inductance.T, rtol=1e-8)
    assert np.all(np.linalg.eigvalsh(inductance) > 0)
    drive = np.array([0.1, 0.0, 0.0])
    change = (with_currents(item, drive).flux_linkages() - with_currents(item, -drive).flux_linkages()) / 0.2
    np.testing.assert_allclose(change, inductance[:, 0], rtol=1e-4)


def test_no_force_at_mid_stroke_of_a_symmetric_stator(spec: Spec, motor: Motor) -> None:
    """Catches a mesh that pushes: yoke ends alike, mover in the middle, no current.

    The alternating diagonals are not quite symmetric: 0.03 N on the default mesh, and less on a finer one.
    """
    yoke = replace(spec.actuator.back_yoke, front_overhang=6.5e-3, back_overhang=6.5e-3)
    actuator = replace(spec.actuator, back_yoke=yoke)

    def forces(refinement: int, positions: Sequence[float]) -> np.ndarray:
        solved = solve_positions(
            lambda z: cross_section(actuator, z, spec.materials, 293.15), positions, None, refinement
        )
        return np.array([item.cogging_force() for item in solved])

    middle, reach = actuator.mid_stroke, 44e-3
    at_rest, behind, ahead = forces(1, [middle, middle - reach, middle + reach])
    assert abs(at_rest) < 0.03
    assert behind + ahead == pytest.approx(0.0, abs=0.03), "cogging is odd about mid-stroke"
    assert abs(forces(2, [middle])[0]) < abs(at_rest) / 2 + 1e-3


def test_cogging_by_stress_and_by_energy(motor: Motor) -> None:
    """Catches a cogging force of another size: a mover that leaves the yoke is pulled back, both routes alike."""
    step, z = 2e-4, -0.045
    behind, here, ahead = motor([z - step, z, z + step])
    by_energy = -(energy(ahead) - energy(behind)) / (2 * step)
    assert abs(by_energy) > 0.5
    assert here.cogging_force() == pytest.approx(by_energy, abs=0.15)


def test_no_magnets_no_current_no_force(motor: Motor) -> None:
    """Catches a force from nothing, and a division by the load."""
    (item,) = motor([0.0262])
    problem = item.solution.problem
    materials = tuple(replace(material, coercivity=(0.0, 0.0)) for material in problem.materials)
    bare = replace(item, solution=solve_grid(item.section, item.grid, materials))
    assert bare.convergence.converged
    assert bare.cogging_force() == 0.0
    assert bare.thrust_constants() == pytest.approx(np.zeros(3))
    assert bare.flux_linkages() == pytest.approx(np.zeros(3))
