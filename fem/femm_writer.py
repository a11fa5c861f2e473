"""Write a model as a magnetics file that FEMM 4.2 opens: every key that FEMM writes, in its order."""

from __future__ import annotations

from numbers import Integral
from typing import SupportsFloat

from fluxbore.design.errors import OutputError, shown
from fluxbore.fem.femm_model import (
    Arc,
    BlockLabel,
    BlockProperty,
    BoundaryProperty,
    CircuitProperty,
    FemmModel,
    PointProperty,
    Segment,
)
from fluxbore.fem.femm_text import shifted

BOUNDARY_TYPES = {"prescribed": 0, "mixed": 2, "periodic": 4, "antiperiodic": 5}
LAMINATION_TYPES = {"in plane": 0, "parallel to x": 1, "parallel to y": 2, "wire": 3}


def write_text(model: FemmModel) -> str:
    """The file's text, lines ending in a line feed. `femm_reader.parse` gives the model back, its path aside.

    A line break in a name or the comment becomes the two characters that FEMM writes for it. Raises OutputError for a
    point property that neither prescribes a potential nor carries a current, which the format cannot say.
    """
    lines = [
        "[Format]      =  4.0",
        "[Frequency]   =  0",
        f"[Precision]   =  {_text(model.precision)}",
        f"[MinAngle]    =  {_text(model.min_angle)}",
        "[DoSmartMesh] =  1",
        f"[Depth]       =  {_text(model.depth)}",
        f"[LengthUnits] =  {model.unit}",
        f"[ProblemType] =  {'axisymmetric' if model.axisymmetric else 'planar'}",
    ]
    if model.axisymmetric and model.exterior is not None:
        outside = model.exterior
        lines += [
            f"[extZo] = {_text(outside.centre)}",
            f"[extRo] = {_text(outside.outer_radius)}",
            f"[extRi] = {_text(outside.inner_radius)}",
        ]
    lines += [
        f"[Coordinates] =  {'polar' if model.polar else 'cartesian'}",
        "[ACSolver]    =  0",
        "[PrevType]    =  0",
        '[PrevSoln]    =  ""',
        f"[Comment]     =  {_quoted(model.comment)}",
        f"[PointProps]   = {len(model.points)}",
        *(line for point in model.points for line in _point(point)),
        f"[BdryProps]   = {len(model.boundaries)}",
        *(line for boundary in model.boundaries for line in _boundary(boundary)),
        f"[BlockProps]  = {len(model.materials)}",
        *(line for material in model.materials for line in _block(material)),
        f"[CircuitProps]  = {len(model.circuits)}",
        *(line for circuit in model.circuits for line in _circuit(circuit)),
        f"[NumPoints] = {len(model.nodes)}",
        *(_row(node.x, node.y, _number(node.prop), node.group) for node in model.nodes),
        f"[NumSegments] = {len(model.segments)}",
        *(_segment(segment) for segment in model.segments),
        f"[NumArcSegments] = {len(model.arcs)}",
        *(_arc(arc) for arc in model.arcs),
        f"[NumHoles] = {len(model.holes)}",
        *(_row(hole.x, hole.y, hole.group) for hole in model.holes),
        f"[NumBlockLabels] = {len(model.labels)}",
        *(_label(label) for label in model.labels),
    ]
    return "\n".join(lines) + "\n"


def _point(point: PointProperty) -> list[str]:
    if point.potential is None and point.current == 0:
        raise OutputError(f"The point property {shown(point.name)} must have a potential or a current; it has neither.")
    return _property(
        "Point",
        {
            "PointName": _quoted(point.name),
            "I_re": point.current,
            "I_im": 0,
            "A_re": point.potential or 0.0,
            "A_im": 0,
        },
    )


def _boundary(boundary: BoundaryProperty) -> list[str]:
    return _property(
        "Bdry",
        {
            "BdryName": _quoted(boundary.name),
            "BdryType": BOUNDARY_TYPES[boundary.kind],
            "A_0": boundary.a0,
            "A_1": boundary.a1,
            "A_2": boundary.a2,
            "Phi": boundary.phase,
            "c0": boundary.c0,
            "c0i": 0,
            "c1": boundary.c1,
            "c1i": 0,
            "Mu_ssd": 0,
            "Sigma_ssd": 0,
            "innerangle": 0,
            "outerangle": 0,
        },
    )


def _block(material: BlockProperty) -> list[str]:
    wire = int(material.lamination == "wire")
    lines = _property(
        "Block",
        {
            "BlockName": _quoted(material.name),
            "Mu_x": material.mu_x,
            "Mu_y": material.mu_y,
            "H_c": material.coercivity,
            "H_cAngle": 0,
            "J_re": _millionth(material.current_density),
            "J_im": 0,
            "Sigma": _millionth(material.conductivity),
            "d_lam": 0,
            "Phi_h": 0,
            "Phi_hx": 0,
            "Phi_hy": 0,
            "LamType": LAMINATION_TYPES[material.lamination],
            "LamFill": material.fill,
            "NStrands": wire,
            "WireD": wire,
            "BHPoints": len(material.curve),
        },
    )
    return [*lines[:-1], *(f"      {_row(b, h)}" for b, h in material.curve), lines[-1]]


def _circuit(circuit: CircuitProperty) -> list[str]:
    return _property(
        "Circuit",
        {
            "CircuitName": _quoted(circuit.name),
            "TotalAmps_re": circuit.current,
            "TotalAmps_im": 0,
            "CircuitType": int(circuit.series),
        },
    )


def _segment(segment: Segment) -> str:
    size = -1 if segment.size is None else segment.size
    return _row(segment.start, segment.end, size, _number(segment.boundary), int(segment.hidden), segment.group)


def _arc(arc: Arc) -> str:
    ends, shape = (arc.start, arc.end), (arc.angle, arc.max_segment)
    # The last column is the side length that FEMM's mesher chose, which it reads back and then renews.
    return _row(*ends, *shape, _number(arc.boundary), int(arc.hidden), arc.group, arc.max_segment)


def _label(label: BlockLabel) -> str:
    formula = isinstance(label.magnetisation, str)
    row = _row(
        label.x,
        label.y,
        _number(label.material),
        -1 if label.size is None else label.size,
        _number(label.circuit),
        0 if isinstance(label.magnetisation, str) else label.magnetisation,
        label.group,
        int(label.turns) if label.turns == int(label.turns) else label.turns,
        int(label.external) + 2 * int(label.default),
    )
    return f"{row}\t{_quoted(str(label.magnetisation))}" if formula else row


def _property(kind: str, entries: dict[str, str | float]) -> list[str]:
    body = [f"    <{key}> = {value if isinstance(value, str) else _text(value)}" for key, value in entries.items()]
    return [f"  <Begin{kind}>", *body, f"  <End{kind}>"]


def _row(*cells: float) -> str:
    return "\t".join(map(_text, cells))


def _text(value: SupportsFloat) -> str:
    """The shortest that reads back as the same number; also for numpy's, whose repr is no number."""
    if type(value) is float or type(value) is int:
        return repr(value)
    return str(int(value)) if isinstance(value, Integral) else repr(float(value))


def _number(index: int | None) -> int:
    """From one, 0 for none."""
    return 0 if index is None else index + 1


def _millionth(value: float) -> str:
    """value / 1e6, so that a reader's multiplication gives exactly ``value`` again."""
    text = _text(value / 1e6)
    if shifted(text, 6) == value:
        return text
    mantissa, _, exponent = repr(float(value)).partition("e")
    return f"{mantissa}e{int(exponent or 0) - 6}"


def _quoted(text: str) -> str:
    return '"' + text.replace("\r\n", "\n").replace("\n", "\\n").replace("\r", "\\n") + '"'
