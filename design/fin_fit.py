"""What is left of the fin's interference when bore and fin miss their sizes, at the coldest and the hottest.

    delta(T) = (D_f (1 + alpha_f (T - T_20)) - D_c' (1 + alpha_c (T - T_20))) / 2  -+  (T_b + T_f) / 4

The diameters of the specification stand in the middle of their tolerance fields, of total widths T_b and T_f: the
worst case, not a scatter. Free expansion of both parts at one temperature; the bore's dilation under pressure (0.3 um
of the prototype at 0.6 MPa) and the mover's play sideways are left out.
"""

from __future__ import annotations

from dataclasses import dataclass

from fluxbore.design.material_kinds import ROOM_TEMPERATURE


@dataclass(frozen=True, slots=True)
class Fit:
    """A diameter with its tolerance field's total width (m) and its material's expansion (1/K)."""

    diameter: float
    tolerance: float
    expansion: float

    def at(self, temperature: float) -> float:
        """The diameter (m) at a temperature (K), in the middle of the field."""
        return self.diameter * (1 + self.expansion * (temperature - ROOM_TEMPERATURE))


def interferences(fin: Fit, bore: Fit, coldest: float, hottest: float) -> tuple[float, float]:
    """The least and the largest radial interference (m) from the coldest to the hottest temperature (K).

    The least is negative where a small fin in a wide bore does not touch.
    """
    middle = [(fin.at(temperature) - bore.at(temperature)) / 2 for temperature in (coldest, hottest)]
    spread = (fin.tolerance + bore.tolerance) / 4
    return min(middle) - spread, max(middle) + spread
