"""The cases of the validation gallery."""

from __future__ import annotations

from collections.abc import Callable

from cases import air_coils, conductors, iron, magnets, periodic, slabs
from cases.case import Case, Check

CASES: tuple[Callable[[], Case], ...] = (
    air_coils.thick_coil,
    air_coils.two_coils,
    air_coils.mutual_inductance,
    air_coils.opposed_coils,
    air_coils.kelvin_exterior,
    air_coils.air_coil_in_a_box,
    air_coils.voice_coil,
    air_coils.smes,
    magnets.cylinder,
    magnets.magnet_pair,
    magnets.unequal_magnets,
    magnets.sphere,
    magnets.transverse_cylinder,
    magnets.torque_on_a_cylinder,
    magnets.halbach_ring,
    iron.sphere_in_a_field,
    iron.ball_and_coil,
    iron.saturated_solenoid,
    iron.saturated_ring,
    iron.cylinder_in_a_field,
    iron.wires_beside_iron,
    conductors.two_wires,
    conductors.two_wires_in_two_discs,
    conductors.confined_wire,
    conductors.point_current,
    conductors.coaxial_cable,
    conductors.parallel_strips,
    periodic.halbach_array,
    periodic.slotless_no_load,
    periodic.slotless_load,
    slabs.laminated_strips,
    slabs.mixed_condition,
)
"""Functions, since the exact values take a second or two."""

__all__ = ["CASES", "Case", "Check"]
