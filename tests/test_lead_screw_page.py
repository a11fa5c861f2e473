"""The page on the magnetic lead screw: its script runs, and the figures that it quotes are the program's."""

import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from lead_screws import ARCS, PITCH, table_i

from fluxbore.design.force_series import ForceSeries
from fluxbore.design.helical_field import (
    engagement_force,
    force_series,
    harmonic_ratios,
    remanence_for_stall_force,
    with_remanence,
)
from fluxbore.design.lead_screw import LeadScrew
from fluxbore.design.lead_screw_figures import (
    back_driving_force,
    back_iron_flux_density,
    largest_acceleration,
    natural_frequency,
    reflected_mass,
    rotor_inertia,
    sinusoidal_spring_constant,
    slip_work,
    spring_constant,
    sudden_load_limit,
    transfer_ratio,
)
from fluxbore.design.step_ripple import force_ripple, stepped_series

PAGE = (Path(__file__).parent.parent / "docs" / "lead_screw.md").read_text(encoding="utf-8")

STALL_FORCE = 192.0


def identified(screw: LeadScrew) -> tuple[LeadScrew, ForceSeries]:
    """With the remanence that makes the stall force."""
    found = with_remanence(screw, remanence_for_stall_force(screw, STALL_FORCE))
    return found, force_series(found)


@pytest.mark.parametrize(
    ("row", "irons"), [("both members", (True, True)), ("translator only", (True, False)), ("none", (False, False))]
)
def test_the_table_of_irons(row: str, irons: tuple[bool, bool]) -> None:
    (line,) = re.findall(rf"^\| {row} \|(.*)\|$", PAGE, re.MULTILINE)
    screw = table_i(*irons)
    second, third = harmonic_ratios(screw)
    known, spring = identified(screw)
    expected = (
        100 * second,
        100 * third,
        force_series(with_remanence(screw, 1.0)).peak[1],
        known.rotor.remanence,
        spring_constant(spring) / 1e3,
    )
    for cell, value in zip(line.split("|"), expected, strict=True):
        digits = len(cell.strip().partition(".")[2])
        assert cell.strip() == f"{value:.{digits}f}"


def test_the_figures_in_brackets() -> None:
    screw, spring = identified(table_i())
    reflected = reflected_mass(screw, 7.68e-5)
    ends = engagement_force(screw, [0.0, PITCH / 2, PITCH / 4])
    iron = back_iron_flux_density(screw)
    assert iron[0] is not None
    assert iron[1] is not None
    quoted = [
        f"transfer ratio ({transfer_ratio(screw):.0f} rad/m)",
        f"peak motor torque ({screw.h * spring.peak[1]:.3f} N m)",
        f"slip ({spring.barrier:.3f} J)",
        f"sudden load ({sudden_load_limit(spring):.0f} N)",
        f"{sudden_load_limit(ForceSeries(spring.amplitude[:1], PITCH)) / spring.amplitude[0]:.4f} F_stall of a sine",
        f"slip ({slip_work(spring, STALL_FORCE):.3f} J at 192 N)",
        f"({back_driving_force(screw, 0.01):.1f} N per 0.01 N m)",
        f"acceleration ({largest_acceleration(STALL_FORCE, 2.55):.1f} m/s²)",
        f"reflected mass ({reflected:.1f} kg)",
        f"({natural_frequency(220e3, 2.55):.1f} Hz, {natural_frequency(220e3, 2.55, reflected):.1f} Hz)",
        f"engagement force ({ends[0]:.1f} N, −{-ends[1]:.1f} N)",
        f"half a pitch; {ends[2]:.2f} N",
        f"adds {ends[0] / STALL_FORCE:.0%} of the stall force".replace("%", " %"),
        f"{iron[0]:.2f} T in the translator and {iron[1]:.2f} T in the rotor",
        f"F_stall/h = {sinusoidal_spring_constant(STALL_FORCE, PITCH) / 1e3:.1f} kN/m",
        f"J is {rotor_inertia(table_i(rotor_iron=False)) * 1e5:.1f}e-5 kg m²",
    ]
    text = " ".join(PAGE.split())
    for figure in quoted:
        assert figure in text


def test_other_magnets_and_readings() -> None:
    """What the text says of 1.3 T, of other recoil permeabilities, of stepped arcs and of the first harmonic alone."""
    screw = table_i()
    text = " ".join(PAGE.split())
    strong = force_series(with_remanence(screw, 1.3)).peak[1]
    assert f"would make {strong:.0f} N: {strong / STALL_FORCE - 1:.0%}".replace("%", " %") in text
    found = []
    for permeability in (1.0, 1.1):
        member = replace(screw.rotor, magnet_permeability=permeability)
        other = replace(screw, translator=member, rotor=member)
        found.append(remanence_for_stall_force(other, STALL_FORCE))
        assert harmonic_ratios(other)[0] == pytest.approx(1.58e-2, abs=5e-5)
    assert f"{found[0]:.3f} or {found[1]:.3f} T" in text
    stepped = replace(screw, translator=replace(screw.translator, arcs=ARCS))
    remanence, ratio = remanence_for_stall_force(stepped, STALL_FORCE), harmonic_ratios(stepped)[0]
    assert f"take {remanence:.3f} T and K_2/K_1 falls to {100 * ratio:.2f} %" in text
    alone = (STALL_FORCE / force_series(with_remanence(screw, 1.0)).amplitude[0]) ** 0.5
    assert f"of the first harmonic alone {alone:.3f} T would do" in text
    wide = replace(screw.rotor, magnet_width=PITCH)
    assert (
        f"K_2/K_1 = {100 * harmonic_ratios(replace(screw, pitch=2 * PITCH, translator=wide, rotor=wide))[0]:.1f} %"
        in text
    )


def test_ripple() -> None:
    """Six arcs against six and against eight: of the force at the stall, and of the torque at rest."""
    text = " ".join(PAGE.split())
    quoted = []
    for count in (6, 8):
        arcs = replace(ARCS, per_turn=count, angle=2 * math.pi / count)
        screw = table_i()
        screw = replace(screw, translator=replace(screw.translator, arcs=ARCS), rotor=replace(screw.rotor, arcs=arcs))
        stall = force_series(screw).peak[1]
        cogging = np.max(stepped_series(screw).torque(0.0, np.linspace(0, math.pi / 3, 600))) / (screw.h * stall)
        quoted += [100 * force_ripple(screw, PITCH / 4) / stall, 100 * float(cogging)]
    assert f"by {quoted[0]:.1f} % peak to peak" in text
    assert f"cog with up to {quoted[1]:.0f} % of its largest torque" in text
    assert f"it is {quoted[2]:.2f} % and {quoted[3]:.1f} %" in text


def test_its_script_runs(capsys: pytest.CaptureFixture[str]) -> None:
    (script,) = re.findall(r"^```python\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)
    exec(compile(script, "lead_screw.md", "exec"), {})
    numbers = [float(number) for number in re.findall(r"[0-9.]+(?:e-[0-9]+)?", capsys.readouterr().out)]
    assert numbers[:3] == pytest.approx([0.01583, 0.000806, 1.2164], rel=1e-3)
    assert numbers[-1] == pytest.approx(remanence_for_stall_force(table_i(rotor_iron=False), STALL_FORCE), rel=1e-12)
