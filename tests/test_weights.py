"""What the drawings weigh is what the figures and the dynamics take: every example, at every place of its stroke."""

from pathlib import Path

import pytest

import fluxbore
from fluxbore.actuators import STROKE_PLACES, assembly_of
from fluxbore.design.spec import Spec, load
from fluxbore.geometry.mass import PartMass, inertia_of, part_masses, total
from fluxbore.optimize.hydrostatic_common import weighed

EXAMPLES = sorted((Path(__file__).parents[1] / "examples").glob("*.toml"))


def rows_of(spec: Spec, place: float = 0.5) -> tuple[PartMass, ...]:
    return part_masses(assembly_of(spec, place), spec.materials)


def of_kind(*kinds: str) -> list[Path]:
    return [path for path in EXAMPLES if load(path).kind.name in kinds]


@pytest.mark.parametrize("path", of_kind("hybrid", "lead-screw"), ids=lambda path: path.stem)
def test_the_moving_mass_is_that_of_the_movers_parts_and_of_what_it_carries(path: Path) -> None:
    spec = load(path)
    figures = fluxbore.evaluate(spec, "network").performance
    for place in STROKE_PLACES.values():
        whole, rows = assembly_of(spec, place), rows_of(spec, place)
        assert figures.moving_mass == pytest.approx(total(rows, "mover") + whole.carried_mass, rel=1e-9)
        assert figures.total_mass == pytest.approx(total(rows) + whole.carried_mass, rel=1e-9)


@pytest.mark.parametrize("path", of_kind("hydrostatic"), ids=lambda path: path.stem)
def test_a_cylinder_that_is_not_weighed_takes_its_masses_as_drawn(path: Path) -> None:
    """The published masses count a carriage and the like; without them the parts do."""
    key = "actuator.output_cylinder"
    spec = load(path, {f"{key}.moving_mass": "", f"{key}.mass": ""})
    for place in STROKE_PLACES.values():
        rows = rows_of(spec, place)
        cylinder = weighed(spec).output_cylinder
        assert cylinder.moving_mass == pytest.approx(total(rows, "mover"), rel=1e-9)
        assert cylinder.mass == pytest.approx(total(rows), rel=1e-9)


@pytest.mark.parametrize("path", of_kind("lead-screw"), ids=lambda path: path.stem)
def test_the_rotor_turns_as_heavily_as_its_parts(path: Path) -> None:
    """kg m² about the axis, which the figures have in closed form, with the motor's own rotor as a number."""
    spec = load(path)
    figures = fluxbore.evaluate(spec, "network").performance
    # The end shields carry the rotor's bearings: they move along the axis and do not turn.
    turning = tuple(row for row in rows_of(spec) if row.part.role != "end shield")
    drawn = float(inertia_of(turning, "mover").tensor[2, 2])
    assert figures.rotor_inertia == pytest.approx(drawn + spec.number("actuator.motor.inertia"), rel=1e-9)
