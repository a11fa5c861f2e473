"""The page on the electro-hydrostatic actuator: its script runs, and its numbers are the program's."""

import re
from pathlib import Path

import numpy as np
import pytest

from fluxbore.design.cylinder_friction import PUBLISHED, least_friction
from fluxbore.design.dynamics.force_reference import HALF, WHOLE
from fluxbore.design.dynamics.force_tracking import PAIRS, Tracking, prehydra_variations, sensitivities, track
from fluxbore.design.hydrostatic import fluid_mass_at_piston
from fluxbore.design.hydrostatic_figures import (
    force_efficiency,
    force_frequency_limit,
    friction_at,
    ideal_force,
    maximum_velocity,
    pushing_force,
    stroke_force,
)
from fluxbore.design.hydrostatic_friction_identification import expected_errors
from fluxbore.design.prehydra_parameters import prehydra

TOP = Path(__file__).parents[3]
PAGE = (TOP / "docs" / "hydrostatic.md").read_text(encoding="utf-8")
ACTUATOR = prehydra()


def rows(*cells: str) -> list[list[str]]:
    """The other cells of the table's rows that begin with these."""
    found = [[cell.strip() for cell in line.strip("|").split("|")] for line in PAGE.splitlines() if line[:1] == "|"]
    return [row[len(cells) :] for row in found if row[: len(cells)] == list(cells)]


def test_the_script_runs(capsys: pytest.CaptureFixture[str]) -> None:
    (script,) = re.findall(r"^```python\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)
    exec(compile(script, "docs/hydrostatic.md", "exec"), {})
    assert capsys.readouterr().out == "F f up to 212.9 N/s\n50 N at 4 Hz: 2.4 N at most, 1.3 N on average\n"


def test_figures_of_the_table() -> None:
    speed, force = least_friction(PUBLISHED)
    shares = force_efficiency(ACTUATOR, 300.0, 0.45, 26e5)
    for name, shown in {
        "force times frequency, (4)": f"{force_frequency_limit(ACTUATOR):.1f} N/s",
        "largest speed": f"{maximum_velocity(ACTUATOR):.3f} m/s",
        "force of the springs over the stroke": f"{stroke_force(ACTUATOR):.1f} N",
        "least friction of a cylinder": f"{force:.1f} N, at {speed * 1e3:.0f} mm/s",
        "friction at 0.45 m/s and 26 bar": f"{friction_at(ACTUATOR, 0.45, 26e5):.1f} N",
        "force at 70 bar, without friction": f"{ideal_force(ACTUATOR):.0f} N",
        "the same, pushing at 0.45 m/s": f"{pushing_force(ACTUATOR, 0.45):.0f} N",
        "force that arrives of 300 N: one cylinder": f"{shares.one_cylinder * 100:.1f} %",
        "both cylinders": f"{shares.both_cylinders * 100:.1f} %",
    }.items():
        assert rows(name)[0][0] == shown
    assert f"{fluid_mass_at_piston(ACTUATOR):.2f} kg at the piston" in PAGE


@pytest.mark.parametrize(
    "name, speeds",
    [
        ("30 evenly, 3 mm/s to 0.45 m/s", np.linspace(3e-3, 0.45, 30)),
        ("30 geometrically, 1 mm/s to 0.45 m/s", np.geomspace(1e-3, 0.45, 30)),
    ],
)
def test_standard_errors_of_the_table(name: str, speeds: np.ndarray) -> None:
    e = expected_errors(PUBLISHED, speeds, 2.0)
    assert rows(name) == [
        [
            f"{e['preload']:.2f} N",
            f"{e['stribeck_force']:.2f} N",
            f"{e['stribeck_decay']:.0f} s/m",
            f"{e['viscous_coefficient']:.2f} N s/m",
        ]
    ]


def errors(found: Tracking) -> tuple[float, float]:
    assert found.max_error is not None
    assert found.mean_absolute_error is not None
    return found.max_error, found.mean_absolute_error


def between(cell: str, unit: str) -> tuple[float, float]:
    """Both ends of "a to b unit"; twice the number of "a unit"."""
    ends = [float(each) for each in cell.removesuffix(unit).split(" to ")]
    return ends[0], ends[-1]


@pytest.mark.full
def test_the_table_of_tracking_is_simulated() -> None:
    """To a hundredth of a newton, and to five degrees: where an error is flat its largest place is not sharp. At 0.1 Hz
    the largest error is one of stick and slip, told as a range."""
    checked = 0
    for pair in PAIRS:
        name = f"{pair.amplitude:g} N, {pair.frequency:g} Hz" + (" *" if pair.assumed else "")
        for reading in (HALF, WHOLE):
            for largest, mean, place, pressures in rows(name, reading):
                found = track(ACTUATOR, pair, reading)
                most, average = errors(found)
                low, high = between(largest, " N")
                assert low - 0.011 <= most <= high + 0.011
                assert float(mean.removesuffix(" N")) == pytest.approx(average, abs=0.011)
                assert found.phase is not None
                assert abs((found.phase - between(place, "°")[0] + 90) % 180 - 90) < 5
                low, high = between(pressures, " bar")
                assert found.least_pressure == pytest.approx(low * 1e5, abs=0.06e5)
                assert found.peak_pressure == pytest.approx(high * 1e5, abs=0.06e5)
                checked += 1
    assert checked == 10


@pytest.mark.full
def test_the_table_of_sensitivities_is_simulated() -> None:
    """To one per cent: stick and slip of the ramp leaves that much."""
    names = {
        "orifices": "orifices' bore",
        "fluid.air_fraction": "air in the fluid",
        "drive.bandwidth": "bandwidth of the velocity loop",
        "drive.delay": "delay of the command",
        "drive.integral_time": "integral time of the velocity loop",
        "drive.force_period": "control period",
        "hose.wall_modulus": "modulus of the hose's wall",
        "friction": "friction of both seals",
        "dead_volumes": "dead volumes",
        "hose.bore": "hose's bore",
        "motor.inertia": "motor's inertia",
        "ball_screw.efficiency": "efficiency of the screw",
        "fluid.bulk_modulus": "bulk modulus of the liquid",
        "output_cylinder.moving_mass": "moving mass of the output",
        "fluid.viscosity": "viscosity",
        "linear_speed": "half width of friction's linear piece",
    }
    for found in sensitivities(ACTUATOR, prehydra_variations(ACTUATOR)):
        ((_, _, largest, mean),) = rows(names[found.variation.path])
        told = [[float(each) for each in cell.removesuffix(" N").split(", ")] for cell in (largest, mean)]
        for place, each in enumerate((found.low, found.high)):
            assert [column[place] for column in told] == pytest.approx(errors(each), rel=0.01), found.variation
