"""A design written for FEMM, read and solved as any file of FEMM's, is the design."""

from collections import Counter
from dataclasses import replace

import numpy as np
import pytest
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from fluxbore.design.bh_curve import MU_0
from fluxbore.design.materials import standard
from fluxbore.design.spec import Spec
from fluxbore.fem.femm_edit import edit
from fluxbore.fem.femm_export import femm_model
from fluxbore.fem.femm_model import FemmModel
from fluxbore.fem.femm_problem import drawing
from fluxbore.fem.femm_reader import parse
from fluxbore.fem.femm_solution import FemmSolution, solve_model
from fluxbore.fem.femm_writer import write_text
from fluxbore.fem.tubular import TubularSolution, solve_positions
from fluxbore.geometry.cross_section import CoilWindow, CrossSection, Rectangle, Region, breakpoints, paint
from fluxbore.geometry.hybrid import cross_section

OFF_CENTRE = 4e-3
"""m from mid-stroke: neither a position of symmetry nor a coil's edge above a ring's."""

FILE_ONLY = 1
"""No refinement: the mesh sizes that are written must do."""


@pytest.fixture(scope="module")
def section(spec: Spec) -> CrossSection:
    return cross_section(spec.actuator, spec.actuator.mid_stroke + OFF_CENTRE, spec.materials, 293.15)


@pytest.fixture(scope="module")
def own(spec: Spec) -> TubularSolution:
    actuator = spec.actuator
    position = actuator.mid_stroke + OFF_CENTRE
    return solve_positions(lambda z: cross_section(actuator, z, spec.materials, 293.15), [position])[0]


def written(section: CrossSection, currents: dict[str, float] | None = None) -> FemmModel:
    return parse(write_text(femm_model(section, currents)))


@pytest.fixture(scope="module")
def idle(section: CrossSection) -> FemmSolution:
    return solve_model(written(section), max_unknowns=FILE_ONLY)


def test_linkages_at_no_current(idle: FemmSolution, own: TubularSolution) -> None:
    """Catches a magnet the wrong way round or too weak, a coil out of place, a phase under another's name."""
    linkages = own.flux_linkages()
    assert [c.name for c in idle.model.circuits] == ["U", "V", "W"]
    assert idle.linkages == pytest.approx(linkages, abs=3e-3 * np.abs(linkages).max())


def test_thrust_on_the_q_axis(section: CrossSection, own: TubularSolution, idle: FemmSolution) -> None:
    """Catches a current's sign or size, and a mover that is not the whole of its group: 1 A, cogging taken off."""
    constants = own.thrust_constants()
    current = constants / np.linalg.norm(constants)
    model = written(section, dict(zip("UVW", current.tolist(), strict=True)))
    busy = solve_model(model, max_unknowns=FILE_ONLY)
    thrust = busy.force(1).by_stress.force[1] - idle.force(1).by_stress.force[1]
    assert thrust == pytest.approx(constants @ current, rel=3e-3)


def test_one_label_for_each_face(section: CrossSection) -> None:
    """Catches rectangles that are not merged, and lines drawn twice."""
    model = femm_model(section)
    count = Counter(label.group for label in model.labels)
    magnets = sum(r.remanence != 0 for r in section.regions)
    assert count == {0: 1, 1: 2 * magnets + 1, 2: 1, 3: len(section.coils)}
    assert len({frozenset((s.start, s.end)) for s in model.segments}) == len(model.segments)
    # Euler: faces inside are lines − points + connected parts.
    ends = np.array([(s.start, s.end) for s in model.segments])
    size = len(model.nodes)
    parts, _ = connected_components(coo_array((np.ones(len(ends)), ends.T), (size, size)), directed=False)
    assert len(ends) - size + parts == len(model.labels)


def test_everything_is_used(section: CrossSection) -> None:
    """Catches materials and nodes that nothing refers to, and numbers that nobody would type."""
    model = femm_model(section)
    assert {label.material for label in model.labels} == set(range(len(model.materials)))
    assert {end for s in model.segments for end in (s.start, s.end)} == set(range(len(model.nodes)))
    assert [m.name for m in model.materials] == ["Air", "Copper", "1010", "N48"]
    assert all(s.boundary is None for s in model.segments if s.group)
    outside = [s for s in model.segments if s.boundary == 0]
    assert len(outside) == 3


def test_magnets_and_iron(section: CrossSection, spec: Spec) -> None:
    """Catches H_c = B_r/μ0 without the recoil permeability, and a curve in other units."""
    model = femm_model(section)
    magnet = next(r for r in section.regions if r.remanence)
    block = next(m for m in model.materials if m.coercivity)
    assert block.mu_x == block.mu_y == magnet.recoil_permeability
    assert block.coercivity * MU_0 * block.mu_y == pytest.approx(abs(magnet.remanence), rel=1e-15)
    directions = [b.magnetisation for b in model.labels if b.material == model.materials.index(block)]
    assert sorted(Counter(directions)) == [90.0, 270.0]
    iron = next(m for m in model.materials if m.curve)
    curve = standard()["1010"].curve
    assert curve is not None
    assert iron.curve == tuple(zip(curve.b, curve.h, strict=True))


def test_the_mover_moves_by_its_group(spec: Spec, section: CrossSection) -> None:
    """Catches nodes of the mover in another group: moved in the file, the drawing is that of the other position."""
    there = cross_section(spec.actuator, spec.actuator.mid_stroke + OFF_CENTRE + 1e-3, spec.materials, 293.15)
    moved = edit(femm_model(section), {"group.1.displacement.z": "1 mm"})
    expected = femm_model(there)
    near = [n for n in range(len(moved.nodes)) if moved.nodes[n].x < 50]  # the far edge follows the mover's ends

    def places(model: FemmModel) -> np.ndarray:
        points = drawing(model).outline.points[near]
        return np.asarray(points[np.lexsort(np.round(points, 9).T)])

    assert places(moved)[:, 0] == pytest.approx(places(expected)[:, 0], abs=1e-12)
    assert np.median(np.abs(places(moved)[:, 1] - places(expected)[:, 1])) < 1e-12


def stacked(turns: float, temperature: float) -> CrossSection:
    """A magnet of two remanences on the axis inside an iron tube, and a coil whose ends lie on no breakpoint."""
    r = breakpoints([0.0, 0.01, 0.02, 0.03, 0.1], ["magnet", "gap", "tube", "far"], 1e-9)
    z = breakpoints([-0.1, -0.02, 0.0, 0.02, 0.1], ["below", "magnet", "magnet", "above"], 1e-9)
    magnet, iron = standard()["N48"], standard()["1010"]
    rectangles = [
        Rectangle(Region("magnet 1", magnet, 1.4, 1.05), (0.0, 0.01), (-0.02, 0.0)),
        Rectangle(Region("magnet 2", magnet, -1.4 + temperature, 1.05), (0.0, 0.01), (0.0, 0.02)),
        Rectangle(Region("back yoke", iron), (0.02, 0.03), (-0.02, 0.02)),
    ]
    regions, cells = paint(r, z, rectangles)
    coils = (
        CoilWindow("U", turns, (0.012, 0.018), (-0.011, 0.007)),
        CoilWindow("U", -turns, (0.012, 0.018), (0.007, 0.013)),
    )
    return CrossSection(r, z, regions, cells, coils, tuple(rectangles), (0.01, 0.012))


def test_magnets_of_two_temperatures_have_two_names() -> None:
    """Catches one material for magnets that differ, or a second material of one name."""
    assert [m.name for m in femm_model(stacked(10, 0.1)).materials] == ["Air", "Copper", "N48", "N48 (2)", "1010"]
    assert [m.name for m in femm_model(stacked(10, 0.0)).materials] == ["Air", "Copper", "N48", "1010"]


def test_whole_turns() -> None:
    """Catches ampere-turns that change with the rounding, and a rounding that nobody is told of."""
    section = stacked(10.4, 0.0)
    model = femm_model(section, {"U": 3.0}, "A design")
    assert [b.turns for b in model.labels if b.group == 3] == [10.0, -10.0]
    assert model.circuits[0].current * 10 == pytest.approx(3.0 * 10.4)
    assert model.comment.splitlines()[0] == "A design"
    assert "Whole turns: linkages of U are 0.961538 times" in model.comment
    assert femm_model(stacked(10, 0.0), comment="A design").comment == "A design"


def test_a_part_on_the_axis_is_closed_there() -> None:
    """Catches an axis without a line where a magnet lies on it, or with the outer boundary's condition."""
    model = femm_model(stacked(10, 0.0))
    axis = [s for s in model.segments if model.nodes[s.start].x == model.nodes[s.end].x == 0]
    assert len(axis) == 4
    assert all(s.boundary is None for s in axis)
    solved = solve_model(model, accuracy=2e-2)
    assert abs(solved.linkages[0]) > 1e-4


def test_a_shared_line_belongs_to_the_iron() -> None:
    """Catches a yoke that cannot be moved whole because a coil lies on it."""
    section = stacked(10, 0.0)
    coil = replace(section.coils[0], r=(0.012, 0.02))
    model = femm_model(replace(section, coils=(coil,)))
    shared = [s for s in model.segments if model.nodes[s.start].x == model.nodes[s.end].x == 20]
    assert {s.group for s in shared} == {2}
    assert {model.nodes[end].group for s in shared for end in (s.start, s.end)} == {2}
