"""What `fluxbore solve` says of a solution: as a JSON object and as text."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import pi
from typing import Any

import numpy as np

from fluxbore.design.errors import one_line
from fluxbore.fem.factors import SingularMatrixError
from fluxbore.fem.femm_model import FemmModel
from fluxbore.fem.femm_solution import FemmSolution, GroupForce

FORCE = (
    "force",
    "torque",
    "force_error",
    "force_by_virtual_work",
    "torque_by_virtual_work",
    "force_by_lorentz",
    "torque_by_lorentz",
)
"""The figures of a group, in the order of the JSON."""

UNSOLVED = "its linear equations could not be solved"


def solution_plain(
    solution: FemmSolution, groups: Sequence[int] = (), points: Sequence[tuple[float, float]] = ()
) -> dict[str, Any]:
    """The JSON object of a solution: SI units, points in the file's unit; None for all figures of one that failed."""
    model, convergence = solution.model, solution.solution.convergence
    mesh = solution.solution.problem.mesh
    energy, coenergy = solution.energies if convergence.converged else (None, None)
    linkages = solution.linkages.tolist() if convergence.converged else [None] * len(model.circuits)
    forces = {group: _force(solution, group) for group in groups}
    inductances = inductances_plain(solution)
    return {
        "problem": {
            "type": "axisymmetric" if model.axisymmetric else "planar",
            "file": model.path,
            "unit": model.unit,
            "depth": None if model.axisymmetric else model.depth * model.metres,
        },
        "mesh": {
            "nodes": int(mesh.nodes.shape[0]),
            "elements": int(mesh.region.size),
            "unknowns": mesh.topology.unknowns,
        },
        "convergence": {
            "status": convergence.status,
            "iterations": convergence.iterations,
            "residual": convergence.residual,
        },
        "accuracy": accuracy_plain(solution),
        "energy": energy,
        "coenergy": coenergy,
        "circuits": {
            name: {"current": item.current, "flux_linkage": linkage}
            for name, item, linkage in zip(circuit_names(model), model.circuits, linkages, strict=True)
        },
        "inductances": inductances or {},
        "groups": {str(group): _force_plain(force) for group, force in forces.items()},
        "points": _points_plain(solution, points),
        "warnings": list(warnings(solution, forces, inductances)),
    }


def circuit_names(model: FemmModel) -> list[str]:
    """The circuits' names; those that come again are numbered, as none may hide another."""
    names: list[str] = []
    for item in model.circuits:
        name, number = item.name, 1
        while name in names:
            number += 1
            name = f"{item.name} ({number})"
        names.append(name)
    return names


def accuracy_plain(solution: FemmSolution) -> dict[str, Any]:
    """What was asked for, what is estimated, and each mesh on the way."""
    levels = solution.adapted.levels
    last = levels[-1]
    return {
        "asked": solution.accuracy,
        "estimate": last.worst if last.estimates else None,
        "reached": solution.adapted.reached,
        "figures": {
            estimate.name: {"error": estimate.error, "relative": estimate.relative} for estimate in last.estimates
        },
        "levels": [
            {
                "elements": level.elements,
                "unknowns": level.unknowns,
                "iterations": level.iterations,
                "figures": {estimate.name: estimate.value for estimate in level.estimates if estimate.name != "points"},
            }
            for level in levels
        ],
    }


def inductances_plain(solution: FemmSolution) -> dict[str, dict[str, float]] | None:
    """Incremental inductances, by the names of both circuits (H); None where the solution has none."""
    names = circuit_names(solution.model)
    if not names or not solution.solution.convergence.converged:
        return {}
    try:
        table = solution.inductances()
    except SingularMatrixError:
        return None
    return {name: {other: float(table[i, j]) for j, other in enumerate(names)} for i, name in enumerate(names)}


def warnings(
    solution: FemmSolution,
    forces: Mapping[int, GroupForce | None],
    inductances: Mapping[str, Mapping[str, float]] | None,
) -> list[str]:
    """What a reader of the figures should know, each in a sentence.

    forces, inductances : with None for what there is not.
    """
    if not solution.solution.convergence.converged:
        return [solution.solution.convergence.sentence()]
    found = []
    if inductances is None:
        found.append(f"There are no incremental inductances: {UNSOLVED}.")
    estimates = solution.adapted.levels[-1].estimates
    if not solution.adapted.reached and not estimates:
        found.append(f"The accuracy of {solution.accuracy * 100:g} % could not be checked: {UNSOLVED}.")
    elif not solution.adapted.reached:
        worst = max(estimates, key=lambda estimate: estimate.relative)
        found.append(
            f"The accuracy of {solution.accuracy * 100:g} % was not reached with "
            f"{solution.solution.problem.mesh.topology.unknowns} unknowns; the estimate is "
            f"{worst.relative * 100:.2g} % ({worst.name})."
        )
    elif not estimates:
        found.append(
            "The energy of point currents is infinite: without --group, --point or a coil there is no figure to refine "
            "the mesh for."
        )
    for x, y in solution.corners:
        found.append(f"({x:g}, {y:g}) is a corner of a magnetic block: the field there has no finite value.")
    for group, force in forces.items():
        if force is None:
            found.append(f"There is no force on group {group}: {UNSOLVED}.")
            continue
        if not force.defined and not force.touches:
            found.append(f"Group {group} has no air around it; there is nothing that could pull on it.")
        if not force.defined and force.touches:
            label = solution.model.labels[force.touches[0]]
            found.append(
                f"Group {group} touches other magnetic material, the block at ({label.x:g}, {label.y:g}); the force "
                "between bodies in contact is not defined."
            )
    return found


def solution_text(plain: Mapping[str, Any]) -> str:
    """A few lines for a person, of `solution_plain`'s object and whatever else was asked."""
    mesh, accuracy, convergence = plain["mesh"], plain["accuracy"], plain["convergence"]
    estimate = accuracy["estimate"]
    lines = [
        f"{plain['problem']['file'] or 'model'}: {plain['problem']['type']}, {mesh['elements']} quadratic triangles, "
        f"{mesh['unknowns']} unknowns",
        f"Newton {convergence['status']} in {_steps(convergence['iterations'])} on the last of "
        f"{len(accuracy['levels'])} meshes" + ("" if estimate is None else f"; estimated error {estimate * 100:.2g} %"),
    ]
    lines += _figures(plain) if convergence["status"] == "converged" else ["no figures: the solution did not converge"]
    lines += [f"wrote {name}" for name in plain.get("files", ())]
    lines += [f"warning: {sentence}" for sentence in plain["warnings"]]
    return "\n".join(one_line(line) for line in lines)  # names are the file's, and may hold what steers a terminal


def _figures(plain: Mapping[str, Any]) -> list[str]:
    """A line for each."""
    axisymmetric = plain["problem"]["type"] == "axisymmetric"
    lines = [f"energy {plain['energy']:.6g} J, coenergy {plain['coenergy']:.6g} J"]
    for name, circuit in plain["circuits"].items():
        own = plain["inductances"].get(name, {}).get(name)
        lines.append(
            f"circuit {name}: {circuit['current']:g} A, flux linkage {circuit['flux_linkage']:.6g} Wb"
            + ("" if own is None else f", incremental inductance {own:.6g} H")
        )
    for number, group in plain["groups"].items():
        if group["force"] is None:
            lines.append(f"group {number}: no force")
            continue
        first, second = group["force"]
        words = f"axial {second:.6g} N" if axisymmetric else f"x {first:.6g} N, y {second:.6g} N"
        turning = "" if axisymmetric else f", torque {group['torque']:.6g} N m"
        error = group["force_error"]
        routes = "" if error is None else f", two routes differ by {error:.2g} N"
        lines.append(f"group {number}: {words}{turning}{routes}")
    names = ("B_r", "B_z") if axisymmetric else ("B_x", "B_y")
    for point in plain["points"]:
        x, y = point["at"]
        lines.append(
            f"({x:g}, {y:g}): {names[0]} {point['B'][0]:.6g} T, {names[1]} {point['B'][1]:.6g} T, "
            f"|B| {float(np.hypot(*point['B'])):.6g} T, A {point['A']:.6g}"
        )
    for line in plain.get("lines", ()):
        lines.append(
            f"line of {line['length']:.6g} m: flux {line['flux']:.6g} Wb, mean B_n {line['mean_flux_density']:.6g} T, "
            f"MMF {line['mmf']:.6g} A, mean H_t {line['mean_tangential_field']:.6g} A/m"
        )
    for group, integrals in plain.get("integrals", {}).items():
        lines.append("integrals of all blocks:" if group == "all" else f"integrals of group {group}:")
        lines += [f"  {name.replace('_', ' ')} {_numbers(value)}" for name, value in integrals.items()]
    return lines


def _numbers(value: float | Sequence[float]) -> str:
    values = value if isinstance(value, Sequence) else (value,)
    return ", ".join(f"{number:.6g}" for number in values)


def _steps(count: int) -> str:
    return "one step" if count == 1 else f"{count} steps"


def _force(solution: FemmSolution, group: int) -> GroupForce | None:
    """None where the solution failed, or where the weight's equations have none."""
    if not solution.solution.convergence.converged:
        return None
    try:
        return solution.force(group)
    except SingularMatrixError:
        return None


def _force_plain(force: GroupForce | None) -> dict[str, Any]:
    if force is None:
        return dict.fromkeys(FORCE)
    routes = force.by_layer if force.value is force.by_stress else None, force.lorentz
    # Between bodies in contact no route tells anything of another.
    values: list[Any] = [list(force.value.force), force.value.torque, force.error if force.defined else None]
    for route in routes:
        values += [None, None] if route is None else [list(route.force), route.torque]
    return dict(zip(FORCE, values, strict=True))


def _points_plain(solution: FemmSolution, points: Sequence[tuple[float, float]]) -> list[dict[str, Any]]:
    if not points:
        return []
    if not solution.solution.convergence.converged:
        names = ("A", "B", "H", "flux") if solution.model.axisymmetric else ("A", "B", "H")
        return [{"at": list(at), **dict.fromkeys(names)} for at in points]
    found = solution.probe(np.array(points, dtype=float))
    rows = []
    for at, a, b, h in zip(points, found.potential, found.flux_density, found.field_strength, strict=True):
        row = {"at": list(at), "A": float(a), "B": b.tolist(), "H": h.tolist()}
        if solution.model.axisymmetric:
            row["flux"] = 2 * pi * float(a)
        rows.append(row)
    return rows
