"""What can be seen of a hybrid actuator: its parts, its field, and its design beside a slotted one."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fluxbore.design.errors import MaterialError
from fluxbore.design.hybrid import HybridActuator
from fluxbore.design.hybrid_values import positions
from fluxbore.design.magnetic_network import Slots, cylinder_insertion
from fluxbore.design.spec import Spec
from fluxbore.geometry import hybrid_parts
from fluxbore.geometry.assembly import Assembly

if TYPE_CHECKING:
    from fluxbore.fem.femm_model import FemmModel
    from fluxbore.reports.content import FluxMap, SlotComparison


def assembly(spec: Spec, place: float = 0.5) -> Assembly:
    """The parts with the mover at this share of its stroke. Raises DesignError where they do not fit."""
    actuator: HybridActuator = spec.actuator
    return hybrid_parts.assembly(actuator, actuator.mid_stroke + (place - 0.5) * actuator.mover.stroke)


def flux_map(spec: Spec) -> FluxMap | None:
    """The design's field at no current in the middle of its window, with the parts' outlines; None unless it
    converges."""
    import numpy as np

    from fluxbore.fem.cell_picture import flux_map as field_map
    from fluxbore.fem.field_loads import tubular_loads
    from fluxbore.fem.threads import one_thread
    from fluxbore.optimize.hybrid_field import intrinsic_coercivity
    from fluxbore.optimize.hybrid_figures import solve_window
    from fluxbore.reports.content import FluxMap

    window = positions(spec.values)
    position = window[len(window) // 2]
    with one_thread():
        solved = solve_window(spec, (position,))[0]
    if not solved.convergence.converged:
        return None
    field = field_map(solved)
    boxes = [(item.region.name, item.r, item.z) for item in solved.section.rectangles]
    boxes += [(f"coil {coil.circuit}", coil.r, coil.z) for coil in solved.section.coils]
    outlines = tuple((name, np.array([(r[0], z[0]), (r[1], z[0]), (r[1], z[1]), (r[0], z[1])])) for name, r, z in boxes)
    return FluxMap(
        field.r,
        field.z,
        field.triangles,
        field.flux,
        field.flux_density,
        outlines,
        position,
        field.region,
        field.components,
        tubular_loads(solved, intrinsic_coercivity(spec)),
    )


def femm_model(spec: Spec) -> FemmModel:
    """The cross-section in the middle of the stroke, without current."""
    from fluxbore.fem import femm_export
    from fluxbore.geometry.hybrid import cross_section

    actuator: HybridActuator = spec.actuator
    temperature = spec.number("operating_point.magnet_temperature")
    section = cross_section(actuator, actuator.mid_stroke, spec.materials, temperature)
    return femm_export.femm_model(section, comment=f"{spec.word('actuator.name')}, mover in the middle of its stroke")


def slot_comparison(spec: Spec) -> SlotComparison | None:
    """Equation (2) for a slotted and a slotless stator while the cylinder's wall grows; None where it fails."""
    from fluxbore.reports.content import SlotComparison

    slots = Slots()
    try:
        found = cylinder_insertion(
            spec.actuator, spec.materials, spec.number("operating_point.magnet_temperature"), slots
        )
    except MaterialError:
        return None
    note = (
        "Equation (2) at the electric loading of one ampere, the same for both. Slots of "
        f"{slots.opening * 1e3:g} mm every {slots.pitch * 1e3:g} mm are assumed: the paper gives none."
    )
    return SlotComparison(found.walls, found.slotted, found.slotless, note)
