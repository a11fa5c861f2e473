"""Losses of a moving magnet array besides the copper's: eddy currents in the cylinder's wall, and the solid yoke.

The stator sees the array's field pass by. In an axisymmetric machine the electric field v B_r it induces runs around
the axis, so that the currents close upon themselves without a way back, and while their own field is small,

    P = c v^2,   F = c v,   c = sigma  integral B_r^2 dV                                            (a)

over the conductor (for a dipole falling in a thin pipe this is the drag of Saslow 1992, Am. J. Phys. 60, 977).

Cylinder. In the picture of Nakata and Noda's equation (1) a pole's flux Phi = B_g pi D_c (tau_f + 2 g_ac) spreads from
tau_f at the magnets to tau_f + 2 g_ac at D_c, so that B_r = Phi / (2 pi r h) over h(r) = tau_f + 2 r - D_m, and

    integral B_r^2 dV = Phi^2 / (2 pi)  integral dr / (r h)    for each of 2 p poles                (b)

Against the finite elements' own integral (Table II): +4 % at the prototype, +25 % at tau_f = 0.5 mm, -6 % at 4 mm,
-25 % at 8 mm, -10 % at tau = 9 mm.

Yoke. It carries an axial flux density B_y sin(pi z / tau), whose growth enters at the inside as a radial flux density
of amplitude B_i = B_y A_y / (D_i tau) that falls to nothing at the outside, so that its mean square over the wall is
B_i^2 / 6 in (a). With the largest flux density along the yoke for B_y this is 1.0 to 3.2 times the finite elements'
integral: an upper bound. Hysteresis is Steinmetz's (1892, Trans. AIEE 9, 3): k_h f B_y^n in each volume, f = v/(2 tau),
fitted below 1 T; above, published exponents grow towards 2 and more.

Valid where the skin depth at the frequency f is well above the wall (three times and more) and the currents' own field
is small, mu_0 sigma v wall / 2 << 1; beyond, (a) is too large. Resistivities are those at 20 degC: a hot wall loses
less.
"""

from __future__ import annotations

import math

from fluxbore.design.bh_curve import MU_0
from fluxbore.design.hybrid import HybridActuator
from fluxbore.design.materials import Material, SoftIron


def drag_coefficient(resistivity: float, square_field: float) -> float:
    """c of (a) (N s/m), for a resistivity (ohm m) and the integral of B_r^2 over the conductor (T^2 m^3)."""
    return square_field / resistivity


def wall_square_field(actuator: HybridActuator, gap_flux_density: float) -> float:
    """Integral (b) of B_r^2 over the cylinder's wall beside the array (T^2 m^3), for B_g at D_c (T)."""
    cylinder, mover = actuator.cylinder, actuator.mover
    inner, outer = cylinder.inner_diameter / 2, cylinder.outer_diameter / 2
    height = min(mover.ring_width + 2 * actuator.air_gap, mover.pole_pitch)
    flux = 2 * math.pi * outer * height * gap_flux_density
    # integral dr / (r (a + 2 r)) = log(r / h) / a between the radii, written so that a = 0 is no exception
    a = mover.ring_width - mover.outer_diameter
    scale = (outer - inner) / (inner * (a + 2 * outer))
    x = a * scale
    spread = scale * (math.log1p(x) / x if abs(x) > 1e-9 else 1.0)
    return actuator.magnets * flux**2 / (2 * math.pi) * spread


def yoke_volume(actuator: HybridActuator) -> float:
    """Of the yoke beside the array (m^3)."""
    yoke = actuator.back_yoke
    return math.pi / 4 * (yoke.outer_diameter**2 - yoke.inner_diameter**2) * actuator.array_length


def yoke_square_field(actuator: HybridActuator, yoke_flux_density: float) -> float:
    """Integral of B_r^2 over the yoke beside the array (T^2 m^3), for the amplitude B_y (T)."""
    yoke = actuator.back_yoke
    area = math.pi / 4 * (yoke.outer_diameter**2 - yoke.inner_diameter**2)
    inside = yoke_flux_density * area / (yoke.inner_diameter * actuator.mover.pole_pitch)
    return inside**2 / 6 * yoke_volume(actuator)


def wall_drag(actuator: HybridActuator, resistivity: float, gap_flux_density: float) -> float:
    """Drag of the cylinder's wall by its speed (N s/m), for its resistivity (ohm m) and B_g at D_c (T)."""
    return drag_coefficient(resistivity, wall_square_field(actuator, gap_flux_density))


def yoke_drag(actuator: HybridActuator, material: Material, yoke_flux_density: float) -> tuple[float, float] | None:
    """Drag of the yoke: hysteresis (N), the same at any speed, and eddy currents by their speed (N s/m).

    None where the material states no coefficient of hysteresis or no resistivity.
    """
    if not isinstance(material, SoftIron) or material.hysteresis_coefficient is None or material.resistivity is None:
        return None
    energy = material.hysteresis_coefficient * abs(yoke_flux_density) ** material.hysteresis_exponent
    hysteresis = energy * yoke_volume(actuator) / (2 * actuator.mover.pole_pitch)
    return hysteresis, drag_coefficient(material.resistivity, yoke_square_field(actuator, yoke_flux_density))


def skin_depth(resistivity: float, pole_pitch: float, speed: float, permeability: float = 1.0) -> float:
    """sqrt(2 rho / (omega mu)) (m) at omega = pi v / tau; SI units, relative permeability. The speed is not zero."""
    return math.sqrt(2 * resistivity * pole_pitch / (math.pi * speed * MU_0 * permeability))
