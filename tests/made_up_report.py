"""A whole report's content, made up but plausible, so that the page can be tested without a single solve."""

from __future__ import annotations

import math

import numpy as np

from fluxbore.design.performance import Performance
from fluxbore.design.spec import KINDS, Note, Spec
from fluxbore.design.study import Axis, Constraint, Objective, Study, Sweep, Variable
from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.outline import rectangle
from fluxbore.geometry.part import Part
from fluxbore.optimize.evaluation import NOT_CONVERGED, OK, Evaluation, PositionResult, failure
from fluxbore.optimize.outcome import Candidate, Check, Limit, SearchResult, SweepResult, SweepRow
from fluxbore.reports.content import FluxMap, PartRow, Picture, ReportContent, SlotComparison
from fluxbore.reports.kind_words import HYBRID

RING, YOKE = "actuator.mover.ring_width", "actuator.back_yoke.thickness"
PAPER = "Nakata and Noda 2023, Fig. 6"
STRAY_LIMIT = 0.0213
PIXEL = bytes.fromhex(
    "89504e470d0a1a0a0000000d49484452000000010000000108060000001f15c4890000000d49444154789c63606060f80f00010401005fe5c34b"
    "0000000049454e44ae426082"
)
"""A transparent PNG of one pixel."""

STUDY = Study(
    objective=Objective("force_constant", True),
    variables=(Variable(RING, 0.5e-3, 6e-3, 0.05e-3), Variable(YOKE, 0.3e-3, 2.5e-3, 0.05e-3)),
    constraints=(
        Constraint("stray_field", upper=1.0, relative_to_start=True),
        Constraint("actuator.back_yoke.thickness", lower=0.5e-3),
    ),
    sweeps=(
        Sweep(
            "Ring width", (Axis(RING, tuple(0.5e-3 * i for i in range(24))),), 1.5e-3, f"{PAPER}(a)", ((1.5e-3, 8.67),)
        ),
        Sweep("Yoke thickness", (Axis(YOKE, tuple(1e-4 + 3e-4 * i for i in range(9))),), 0.4e-3, f"{PAPER}(b)"),
    ),
    hold=("actuator.winding.turns_density",),
)


def a_spec(name: str = "iPEHLA prototype", ring: float = 1.5e-3, yoke: float = 1e-3) -> Spec:
    mm = 1e-3
    given: dict[str, float | int | str] = {
        "actuator.name": name,
        "actuator.back_yoke.outer_diameter": 27 * mm,
        "actuator.back_yoke.thickness": yoke,
        "actuator.back_yoke.front_overhang": 3 * mm,
        "actuator.back_yoke.back_overhang": 10 * mm,
        "actuator.back_yoke.material": "pure iron",
        "actuator.winding.yoke_clearance": 0.4 * mm,
        "actuator.winding.sets_per_phase": 8,
        "actuator.winding.turns_density": 4.345e6,
        "actuator.winding.wire_diameter": 0.4 * mm,
        "actuator.winding.material": "copper",
        "actuator.cylinder.outer_diameter": 20 * mm,
        "actuator.cylinder.inner_diameter": 16.1 * mm,
        "actuator.cylinder.catalogue_bore": 16 * mm,
        "actuator.cylinder.length": 225 * mm,
        "actuator.cylinder.material": "aluminium",
        "actuator.mover.pole_pitch": 12 * mm,
        "actuator.mover.ring_width": ring,
        "actuator.mover.pole_pairs": 4,
        "actuator.mover.outer_diameter": 15.9 * mm,
        "actuator.mover.magnet": "N48H",
        "actuator.mover.remanence": 1.4,
        "actuator.mover.magnet_permeability": 1.05,
        "actuator.mover.ring_material": "pure iron",
        "actuator.mover.stroke": 88 * mm,
        "actuator.shaft.outer_diameter": 8 * mm,
        "actuator.shaft.length": 235 * mm,
        "actuator.shaft.material": "stainless steel",
        "operating_point.pressure": 0.6e6,
        "operating_point.current": 1.0,
        "operating_point.first_position": 24 * mm,
        "operating_point.last_position": 31 * mm,
        "operating_point.positions": 8,
        "operating_point.winding_temperature": 293.15,
    }
    notes = (
        Note("actuator.back_yoke.material", "assumed", "the paper says only: iron with a low carbon content"),
        Note("actuator.mover.magnet_permeability", "assumed", "not published; 1.05 is usual for NdFeB"),
        Note("actuator.end_caps.rod_clearance", "calibrated", "chosen so that the retracting force is 90 N"),
    )
    return Spec(KINDS["hybrid"], given, STUDY, notes, {}, {})


def force(ring: float, yoke: float) -> float:
    """A hill of the force constant (N/A) over ring width and yoke thickness (m)."""
    r, y = ring * 1e3, yoke * 1e3
    return 8.67 * (1.02 - 0.008 * (r - 1.55) ** 2 - 0.11 * (y - 0.82) - 0.3 * math.exp(-y / 0.12))


def performance(ring: float, yoke: float) -> Performance:
    constant = force(ring, yoke)
    resistance = 5.553 * (1 + 0.12 * (1e-3 - yoke) * 1e3)
    return Performance(
        force_constant=constant,
        force_constant_linkage=constant * 1.0013,
        motor_constant=constant / math.sqrt(1.5 * resistance),
        winding_resistance=resistance,
        turns=584 + 60 * (1e-3 - yoke) * 1e3,
        pneumatic_force_advance=120.637,
        pneumatic_force_retract=90.478,
        moving_mass=0.17312 + 1.1 * (ring - 1.5e-3),
        total_mass=0.7423 - 60 * (1e-3 - yoke),
        stray_field=STRAY_LIMIT * (1e-3 / yoke) ** 0.9 * (1 - 200 * (ring - 1.5e-3)),
        yoke_flux_density=1.62,
        ring_flux_density=1.21,
        gap_flux_density=0.4112,
        cogging_force=0.0312,
        demagnetised_fraction=0.0,
        electric_loading=7546.0,
        copper_loss=8.33,
        outer_diameter=0.027,
        length=0.249,
    )


def fem(ring: float, yoke: float) -> Evaluation:
    figures = performance(ring, yoke)
    constant = figures.force_constant or 0.0
    positions = []
    for i in range(8):
        z, ripple = 0.024 + 1e-3 * i, 1 + 0.0027 * math.cos(2 * math.pi * i / 4)
        angle = math.pi * z / 0.012
        thrust = tuple(2 / 3 * constant * ripple * math.cos(angle - 2 * math.pi * k / 3) for k in range(3))
        linkage = tuple(0.0221 * math.sin(angle - 2 * math.pi * k / 3) for k in range(3))
        positions.append(
            PositionResult(
                z,
                (thrust[0], thrust[1], thrust[2]),
                (linkage[0], linkage[1], linkage[2]),
                constant * ripple,
                constant * ripple * 1.0013,
                0.031 * math.sin(2 * angle),
                7 + i % 3,
                2.1e-11 * (i + 1),
            )
        )
    return Evaluation("fem", OK, (), figures, tuple(positions), {"elements": 9216.0, "nodes": 18737.0})


def network(ring: float, yoke: float) -> Evaluation:
    fine = performance(ring, yoke)
    figures = Performance(
        force_constant=(fine.force_constant or 0.0) * 1.21,
        motor_constant=(fine.motor_constant or 0.0) * 1.21,
        winding_resistance=fine.winding_resistance,
        turns=fine.turns,
        pneumatic_force_advance=fine.pneumatic_force_advance,
        pneumatic_force_retract=fine.pneumatic_force_retract,
        moving_mass=fine.moving_mass,
        gap_flux_density=0.509,
        electric_loading=7546.0,
    )
    return Evaluation("network", OK, (), figures, (), {"R_g": 0.98e7, "R_m": 5.4e7})


def candidate(ring: float, yoke: float, evaluation: Evaluation | None = None) -> Candidate:
    found = evaluation or fem(ring, yoke)
    stray = found.performance.stray_field
    margin = None if stray is None else 1 - stray / STRAY_LIMIT
    checks = (
        Check(Limit("stray_field", "<=", STRAY_LIMIT), stray, margin, margin is None or margin >= -1e-6, margin == 0.0),
        Check(Limit(YOKE, ">=", 0.5e-3), yoke, yoke / 0.5e-3 - 1, yoke >= 0.5e-3, abs(yoke - 0.5e-3) < 1e-6),
    )
    return Candidate({RING: ring, YOKE: yoke}, found, found.performance.force_constant, checks)


def a_search() -> SearchResult:
    """Thirty designs that close in on a ring of 2.4 mm and a yoke of 0.8 mm, some infeasible, one failed."""
    history = []
    for i in range(30):
        swing = math.exp(-i / 7)
        ring, yoke = 2.4e-3 - 0.9e-3 * swing * math.cos(i), 0.794e-3 + 0.3e-3 * swing * math.sin(1.7 * i)
        crashed = failure("fem", NOT_CONVERGED, "The field did not converge in 60 steps.") if i == 9 else None
        history.append(candidate(ring, yoke, crashed))
    best: list[int | None] = []
    for i, item in enumerate(history):
        last = best[-1] if best else None
        better = last is None or (item.objective or 0.0) > (history[last].objective or 0.0)
        best.append(i if item.feasible and better else last)
    top = best[-1]
    assert top is not None
    return SearchResult(
        start=candidate(1.5e-3, 1e-3),
        network_start=candidate(2.1e-3, 0.62e-3),
        history=tuple(history),
        best_so_far=tuple(best),
        best=history[top],
        rounded=candidate(2.4e-3, 0.8e-3),
        stop_reason="COBYLA ended because the force constant changed by less than 0.0001 of itself.",
        seconds=41.3,
    )


def a_sweep(sweep: Sweep) -> SweepResult:
    axis = sweep.axes[0]
    rows = []
    for value in axis.values:
        ring, yoke = (value, 1e-3) if axis.key == RING else (1.5e-3, value)
        evaluation = fem(ring, yoke)
        if value == axis.values[-1] and axis.key == YOKE:
            evaluation = failure("fem", NOT_CONVERGED, "The field did not converge in 60 steps.")
        rows.append(SweepRow({axis.key: value}, evaluation))
    return SweepResult(sweep, tuple(rows))


def a_flux_map(ring: float, yoke: float) -> FluxMap:
    """A travelling wave of flux that dies out away from the array, on a regular grid of triangles."""
    position, pitch = 0.0275, 0.012
    r, z = np.linspace(0, 0.024, 25), np.linspace(-0.04, 0.26, 351)
    rr, zz = np.meshgrid(r, z, indexing="ij")
    inside = 1 / (1 + np.exp(-(zz - position) / 2e-3)) / (1 + np.exp((zz - position - 8 * pitch) / 2e-3))
    radial = (rr / 8e-3) ** 2 * np.exp(-np.maximum(rr - 8e-3, 0) / 3.4e-3)
    flux = 3.1e-5 * inside * radial * np.cos(math.pi * (zz - position) / pitch)
    d_r, d_z = np.gradient(flux, r, z)
    density = np.hypot(d_r, d_z) / np.maximum(rr, 4e-4)
    number = np.arange(rr.size).reshape(rr.shape)
    a, b, c, d = number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]
    triangles = np.concatenate([np.stack([a, b, c], -1).reshape(-1, 3), np.stack([a, c, d], -1).reshape(-1, 3)])
    outlines = tuple((part.name, np.array(part.profile)) for part in an_assembly(ring, yoke).parts)
    both = np.column_stack([(part / np.maximum(rr, 4e-4)).ravel() for part in (-d_z, d_r)])
    components = both[triangles].mean(axis=1)
    return FluxMap(
        rr.ravel(), zz.ravel(), triangles, flux.ravel(), density.ravel(), outlines, position, None, components
    )


def an_assembly(ring: float = 1.5e-3, yoke: float = 1e-3) -> Assembly:
    position, pitch, inner = 0.0275, 0.012, 0.0135 - yoke
    grey, blue = (0.45, 0.49, 0.54), (0.25, 0.45, 0.72)
    parts = [
        Part(
            "back yoke", "back yoke", "stator", "pure iron", (0.36, 0.4, 0.45), rectangle(inner, 0.0135, -0.014, 0.191)
        )
    ]
    copper = ((0.80, 0.36, 0.20), (0.87, 0.55, 0.22), (0.66, 0.42, 0.30))
    for i in range(24):
        box = rectangle(0.010, inner - 4e-4, -0.004 + 0.008 * i, 0.004 + 0.008 * i)
        parts.append(Part(f"coil {i + 1:02d} {'UVW'[i % 3]}", "coil", "stator", "copper", copper[i % 3], box))
    tube = rectangle(0.00805, 0.010, -0.0205, 0.2045)
    parts.append(Part("cylinder tube", "cylinder tube", "stator", "aluminium", (0.76, 0.79, 0.83), tube))
    shaft = rectangle(0.0, 0.004, position - 0.01, position + 0.225)
    parts.append(Part("shaft", "shaft", "mover", "stainless steel", (0.84, 0.84, 0.82), shaft))
    for i in range(8):
        low = position + pitch * i + ring / 2
        box = rectangle(0.004, 0.00795, low, low + pitch - ring)
        parts.append(Part(f"magnet {i + 1}", "magnet", "mover", "N48H", blue, box))
    for i in range(9):
        low, high = max(position, position + pitch * i - ring / 2), position + pitch * i + ring / 2
        box = rectangle(0.004, 0.00795, low, min(high, position + 8 * pitch))
        parts.append(Part(f"ring {i + 1}", "ring", "mover", "pure iron", grey, box))
    return Assembly("iPEHLA prototype", tuple(parts), position)


def a_content(name: str = "iPEHLA prototype") -> ReportContent:
    search = a_search()
    chosen = search.chosen
    assert chosen is not None
    parts = tuple(
        PartRow(part, group, material, size, mass / density, mass, count)
        for part, group, material, size, density, mass, count in (
            ("back yoke", "stator", "pure iron", "ø 27 × ø 25.1 × 205 mm", 7870.0, 0.1259, 1),
            ("coil", "stator", "copper", "ø 24.3 × ø 20 × 8 mm", 8960.0, 0.00595, 24),
            ("cylinder tube", "stator", "aluminium", "ø 20 × ø 16.1 × 225 mm", 2700.0, 0.0672, 1),
            ("end cap", "stator", "aluminium", "ø 27 × 15 mm", 2700.0, 0.0211, 2),
            ("shaft", "mover", "stainless steel", "ø 8 × 235 mm", 7930.0, 0.0937, 1),
            ("magnet", "mover", "N48H", "ø 15.9 × ø 8 × 9.6 mm", 7600.0, 0.01082, 8),
            ("ring", "mover", "pure iron", "ø 15.9 × ø 8 × 2.4 mm", 7870.0, 0.00280, 7),
            ("half ring", "mover", "pure iron", "ø 15.9 × ø 8 × 1.2 mm", 7870.0, 0.00140, 2),
            ("piston", "mover", "POM", "ø 16.3 × 6 mm", 1410.0, 0.00144, 2),
        )
    )
    walls = tuple(0.25e-3 * i for i in range(9))
    return ReportContent(
        spec=a_spec(name),
        chosen_spec=a_spec(name, 2.4e-3, 0.8e-3),
        start=fem(1.5e-3, 1e-3),
        chosen=chosen.evaluation,
        start_network=network(1.5e-3, 1e-3),
        chosen_network=network(2.4e-3, 0.8e-3),
        search=search,
        sweeps=tuple(a_sweep(sweep) for sweep in STUDY.sweeps),
        one_at_a_time=candidate(1.5e-3, 0.4e-3),
        flux_map=a_flux_map(2.4e-3, 0.8e-3),
        start_flux_map=a_flux_map(1.5e-3, 1e-3),
        slots=SlotComparison(
            walls,
            tuple(18.7 - 2500 * wall for wall in walls),
            tuple(10.5 for _ in walls),
            "Electric loading held; slot opening 2 mm, slot pitch 4 mm (assumed).",
        ),
        parts=parts,
        assembly=an_assembly(2.4e-3, 0.8e-3),
        picture=Picture(PIXEL),
        checked=("168 pairs of parts: no overlap but the two seal fins, by design.", "48 STEP files re-imported."),
        not_checked=("Friction of the seal fins.", "Temperature rise in continuous operation.", "Eddy currents."),
        provenance={
            "fluxbore": "0.1.0",
            "numpy": "2.3.5",
            "scipy": "1.16.3",
            "Specification (SHA-256)": "9f2c" * 16,
            "Date": "2025-01-31 12:00 UTC",
            "Command": "fluxbore design examples/ipehla.toml -o out",
        },
        seconds=73.2,
        words=HYBRID,
    )
