"""From what a FEMM file says to what the solver takes: an outline with its conditions, then a problem on its mesh."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, radians

import numpy as np

from fluxbore.design.bh_curve import MU_0, BHCurve
from fluxbore.design.errors import SpecError, shown
from fluxbore.fem.conditions import ConditionedMesh, Conditions, Mixed, Prescribed
from fluxbore.fem.conductors import circuit, region_measure
from fluxbore.fem.femm_drawing import axis_width
from fluxbore.fem.femm_model import BlockLabel, BlockProperty, BoundaryProperty, FemmModel
from fluxbore.fem.formula import Formula, parse_formula
from fluxbore.fem.kelvin import KelvinExterior
from fluxbore.fem.mesh import Floats, Ints, Mesh
from fluxbore.fem.outline import HOLE, Curve, Outline, Pair, Seed
from fluxbore.fem.problem import Circuit, Conductor, Field, MagneticMaterial, Problem, Stack
from fluxbore.fem.reluctivity import VACUUM_RELUCTIVITY, ReluctivityCurve, reluctivity_curve


@dataclass(frozen=True, slots=True, eq=False)
class Drawing:
    """An outline and what holds on it. Region i of the outline is label i of the file."""

    outline: Outline
    conditions: Conditions


def drawing(model: FemmModel) -> Drawing:
    """The outline of a file.

    Raises SpecError where a label has no material, or a periodic condition is not on exactly two curves of a kind.
    """
    unit = model.metres
    curves = [Curve(s.start, s.end, 0.0, _length(s.size, unit), _condition(model, s.boundary)) for s in model.segments]
    for arc in model.arcs:
        turn = radians(arc.angle)
        a, b = model.nodes[arc.start], model.nodes[arc.end]
        radius = np.hypot(b.x - a.x, b.y - a.y) * unit / (2 * np.sin(turn / 2))
        size = float(radius) * radians(arc.max_segment)
        curves.append(Curve(arc.start, arc.end, turn, size, _condition(model, arc.boundary)))
    seeds = [_seed(model, number, label) for number, label in enumerate(model.labels)]
    seeds += [Seed((hole.x * unit, hole.y * unit), HOLE) for hole in model.holes]
    nodes = np.array([(node.x, node.y) for node in model.nodes], dtype=float).reshape(-1, 2)
    if model.axisymmetric:
        nodes[np.abs(nodes[:, 0]) < axis_width(model.nodes), 0] = 0.0
    outline = Outline(
        "axisymmetric" if model.axisymmetric else "planar",
        nodes * unit,
        tuple(curves),
        tuple(seeds),
        _pairs(model),
        unit,
        {"millimeters": "mm", "centimeters": "cm", "meters": "m", "microns": "um", "inches": "in"}.get(
            model.unit, model.unit
        ),
    )
    points = {
        number: model.points[node.prop].potential or 0.0
        for number, node in enumerate(model.nodes)
        if node.prop is not None and model.points[node.prop].current == 0.0
    }
    return Drawing(outline, Conditions([_rule(model, item) for item in model.boundaries], points))


def problem(model: FemmModel, conditioned: ConditionedMesh, vertex: Ints) -> Problem:
    """The problem of a file on a mesh of its drawing.

    vertex : (p,) node of each of the file's nodes, −1 where there is none.
    """
    mesh = conditioned.mesh
    materials = tuple(_material(model, label) for label in model.labels)
    return Problem(
        mesh,
        materials,
        tuple(_circuit(model, number, mesh) for number in range(len(model.circuits))),
        (*_block_sources(model, mesh), *_point_sources(model, mesh, vertex)),
        conditioned.prescribed,
        conditioned.edges,
        model.depth * model.metres,
    )


def _length(size: float | None, unit: float) -> float | None:
    return None if size is None else size * unit


def _condition(model: FemmModel, number: int | None) -> int | None:
    """The number of a condition that the mesh's builder knows; periodic ones are pairs instead."""
    if number is None or model.boundaries[number].kind in ("periodic", "antiperiodic"):
        return None
    item = model.boundaries[number]
    if item.kind == "mixed" and item.c0 < 0:  # what lies beyond would give out energy without end
        raise SpecError(f"{_file(model)}: c0 of boundary {shown(item.name)} must not be negative; got {item.c0:g}.")
    return number


def _seed(model: FemmModel, number: int, label: BlockLabel) -> Seed:
    if label.material is None:
        raise SpecError(f"{_file(model)}: the block label at ({label.x:g}, {label.y:g}) has no material.")
    unit = model.metres
    return Seed((label.x * unit, label.y * unit), number, _length(label.size, unit), label.default)


def _file(model: FemmModel) -> str:
    return model.path or "the file"


def _pairs(model: FemmModel) -> tuple[Pair, ...]:
    pairs = []
    for number, item in enumerate(model.boundaries):
        if item.kind not in ("periodic", "antiperiodic"):
            continue
        segments = [k for k, s in enumerate(model.segments) if s.boundary == number]
        arcs = [len(model.segments) + k for k, a in enumerate(model.arcs) if a.boundary == number]
        if not segments and not arcs:
            continue
        if sorted((len(segments), len(arcs))) != [0, 2]:
            raise SpecError(
                f'{_file(model)}: the {item.kind} boundary "{item.name}" must be on exactly two segments or two arcs; '
                f"it is on {len(segments)} segments and {len(arcs)} arcs."
            )
        first, second = segments or arcs
        pairs.append(Pair(first, second, 1 if item.kind == "periodic" else -1))
    return tuple(pairs)


def _rule(model: FemmModel, item: BoundaryProperty) -> Prescribed | Mixed:
    if item.kind == "mixed":
        return Mixed(item.c0, item.c1)
    unit, polar, real = model.metres, model.polar, cos(radians(item.phase))

    def potential(positions: Floats) -> Floats:
        x, y = positions[:, 0], positions[:, 1]
        if polar:
            x, y = np.hypot(x, y), np.degrees(np.arctan2(y, x)) * unit
        return np.asarray((item.a0 + (item.a1 * x + item.a2 * y) / unit) * real)

    return Prescribed(potential)


def _material(model: FemmModel, label: BlockLabel) -> MagneticMaterial:
    assert label.material is not None
    block = model.materials[label.material]
    if block.lamination == "wire":
        return MagneticMaterial(grade=_grade(model, label))
    coercivity = _coercivity(model, label, block)
    if not block.curve:
        return MagneticMaterial(_reluctivity(block), coercivity, grade=_grade(model, label))
    rows = np.array(block.curve)
    b, h = rows[:, 0], rows[:, 1]
    stack = None
    if block.fill < 1:
        if block.lamination == "in plane":  # sheets and gaps share the field strength
            b = block.fill * b + (1 - block.fill) * MU_0 * h
        else:
            stack = Stack(block.fill, 0 if block.lamination == "parallel to x" else 1)
    return MagneticMaterial(coercivity=coercivity, curve=_curve(block.name, b, h, _file(model)), stack=stack)


def _curve(name: str, b: Floats, h: Floats, source: str) -> ReluctivityCurve:
    """Tables of FEMM's own library end a few per cent below the slope of vacuum: their steps of H are cut to it."""
    b, h = (values if b[0] == 0 else np.concatenate(([0.0], values)) for values in (b, h))
    h = np.concatenate(([0.0], np.cumsum(np.minimum(np.diff(h), np.diff(b) * VACUUM_RELUCTIVITY))))
    return reluctivity_curve(BHCurve(name, tuple(b.tolist()), tuple(h.tolist()), source))


def _reluctivity(block: BlockProperty) -> tuple[float, float]:
    """Along x and y, of sheets and the gaps between them."""
    fill = block.fill
    along = [fill * mu + (1 - fill) for mu in (block.mu_x, block.mu_y)]
    across = [1 / (fill / mu + (1 - fill)) for mu in (block.mu_x, block.mu_y)]
    if block.lamination == "parallel to x":
        mu = along[0], across[1]
    elif block.lamination == "parallel to y":
        mu = across[0], along[1]
    else:
        mu = along[0], along[1]
    return VACUUM_RELUCTIVITY / mu[0], VACUUM_RELUCTIVITY / mu[1]


def _coercivity(model: FemmModel, label: BlockLabel, block: BlockProperty) -> tuple[float, float] | Field:
    if block.coercivity == 0.0:
        return 0.0, 0.0
    if not isinstance(label.magnetisation, str):
        angle = label.magnetisation
        # The quarter turns exactly: a magnet across the axis must not leak 1e-16 along it.
        quarter = {0.0: (1.0, 0.0), 90.0: (0.0, 1.0), 180.0: (-1.0, 0.0), 270.0: (0.0, -1.0)}.get(angle % 360)
        x, y = quarter or (float(np.cos(np.radians(angle))), float(np.sin(np.radians(angle))))
        return block.coercivity * x, block.coercivity * y
    return _varying(parse_formula(label.magnetisation), block.coercivity, model.metres)


def _varying(formula: Formula, coercivity: float, unit: float) -> Field:
    def field(positions: Floats) -> Floats:
        angle = np.radians(formula.evaluate(positions[..., 0] / unit, positions[..., 1] / unit))
        return np.asarray(coercivity * np.stack((np.cos(angle), np.sin(angle)), axis=-1))

    return field


def _grade(model: FemmModel, label: BlockLabel) -> KelvinExterior | None:
    if not label.external or not model.axisymmetric:
        return None
    if model.exterior is None:
        raise SpecError(
            f"{_file(model)}: the label at ({label.x:g}, {label.y:g}) is in an exterior region, and the file does not "
            "say where that is ([extZo], [extRo], [extRi])."
        )
    unit, exterior = model.metres, model.exterior
    return KelvinExterior(exterior.centre * unit, exterior.inner_radius * unit, exterior.outer_radius * unit)


def _circuit(model: FemmModel, number: int, mesh: Mesh) -> Circuit:
    """In series every turn carries the current; in parallel the blocks share it by their conductance."""
    item = model.circuits[number]
    members = [k for k, label in enumerate(model.labels) if label.circuit == number]
    if item.series:
        conductors = [_in_series(model, mesh, k) for k in members]
    else:
        conductors = _in_parallel(model, mesh, members)
    return circuit(mesh, item.name, [c for c in conductors if c is not None], item.current)


def _block(model: FemmModel, label: int) -> BlockProperty:
    material = model.labels[label].material
    assert material is not None
    return model.materials[material]


def _solid(model: FemmModel, label: int) -> bool:
    """Whether a block is one conductor in which the current spreads by itself, rather than a winding."""
    block = _block(model, label)
    return block.lamination != "wire" and abs(model.labels[label].turns) <= 1 and block.conductivity > 0


def _in_series(model: FemmModel, mesh: Mesh, label: int) -> Conductor | None:
    by_radius = model.axisymmetric and _solid(model, label) and not _on_axis(mesh, label)
    measure = region_measure(mesh, label, by_radius)
    return Conductor(label, model.labels[label].turns / measure, by_radius) if measure > 0 else None


def _in_parallel(model: FemmModel, mesh: Mesh, members: list[int]) -> list[Conductor | None]:
    solid = [k for k in members if _solid(model, k)]
    if not solid:  # nothing conducts: one current density for all
        area = sum(region_measure(mesh, k) for k in members)
        return [Conductor(k, 1 / area) for k in members] if area > 0 else []
    by_radius = model.axisymmetric and not any(_on_axis(mesh, k) for k in solid)
    conductance = {k: _block(model, k).conductivity * region_measure(mesh, k, by_radius) for k in solid}
    total = sum(conductance.values())
    return [Conductor(k, _block(model, k).conductivity / total, by_radius) for k in solid] if total > 0 else []


def _on_axis(mesh: Mesh, region: int) -> bool:
    """On the axis one voltage a turn would drive an infinite current density: it is taken as even instead."""
    return bool(np.any(mesh.nodes[mesh.elements[mesh.region == region], 0] <= 0))


def _block_sources(model: FemmModel, mesh: Mesh) -> list[Circuit]:
    conductors = []
    for number, label in enumerate(model.labels):
        # In a circuit the circuit says how much flows: FEMM takes the block's own current off the circuit's.
        if label.material is None or label.circuit is not None:
            continue
        density = model.materials[label.material].current_density
        if density:
            conductors.append(Conductor(number, density))
    return [circuit(mesh, "", conductors, 1.0)] if conductors else []


def _point_sources(model: FemmModel, mesh: Mesh, vertex: Ints) -> list[Circuit]:
    load = np.zeros(mesh.nodes.shape[0])
    for number, node in enumerate(model.nodes):
        current = 0.0 if node.prop is None else model.points[node.prop].current
        if current and vertex[number] >= 0:
            load[int(vertex[number])] += current
    return [Circuit("", load, 1.0)] if load.any() else []
