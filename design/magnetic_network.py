"""The magnetic network of a tubular motor with axially magnetised magnets: gap flux density and thrust in closed form.

Nakata and Noda (2023), Fig. 4(a) and equations (1) and (2), after Bianchi et al. (2003), IEEE Trans. Ind. Appl. 39,
466. One magnet of remanent potential F_rem and reluctance R_m drives its flux from the ring at A to the ring at B. Each
ring's gap is R_g, whole and shared by the two magnets beside it; two gaps lie in series, so that a magnet sees 4 R_g,
and beside it the leakage R_m' through the shaft and along the gap:

    B_g0 = 2 k_g / (pi D_c tau_f) * F_rem / (4 R_g (R_m / R_m' + 1) + R_m),   k_g = tau_f / (tau_f + 2 g_ac)     (1)
    F    = 4 p D_c tau K_sp B_g0 sin(pi/2 (tau_f + 2 g_ac) / tau)                                                (2)

with
    F_rem = B_r tau_m / (mu_0 mu_r)
    R_m   = tau_m / (mu_0 mu_r pi (D_m^2 - D_s^2) / 4)
    R_g   = ln(1 + 2 g_eff / D_m) / (2 pi mu_0 (tau_f + 2 g_ac))     radial tube of the paper's height tau_f + 2 g_ac
    R_m'  = shaft tube beside gap tube

The parts of R_m' are not given in the paper. The shaft is a straight tube under the magnet, of reluctance
tau_m / (mu_0 mu_s pi D_s^2 / 4). The gap tube is the annulus from D_m to D_c where no ring's tube stands already,
over a length l = tau_m - 2 g_ac; the magnet's potential U falls evenly along it, so the tube stores the energy of a
field U / tau_m over l, which is a reluctance tau_m^2 / (mu_0 l pi (D_c^2 - D_m^2) / 4). Compared with the Laplace
field of that same potential between mover and yoke and in the shaft (Table II, infinitely permeable iron): R_g is
right to 2 % for the flux that reaches the yoke; the magnet's load is 12 % too large, which lowers B_g0; and the thrust
(2) is 2 % above that of the field's fundamental at the winding's mean diameter.

Valid for tau_f + 2 g_ac <= tau, beyond which the rings' tubes would overlap (`MagneticNetwork.tubes_overlap`).

The paper says that a cylinder inserted in a slotted motor makes R_m' increase and R_g decrease, so that B_g0 drops. By
(1) those signs would raise B_g0; the directions are swapped: R_m' decreases, R_g increases, and B_g0 does drop.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from fluxbore.design.bh_curve import MU_0
from fluxbore.design.carter import carter_coefficient
from fluxbore.design.errors import MaterialError
from fluxbore.design.hybrid import HybridActuator
from fluxbore.design.materials import ROOM_TEMPERATURE, Library, Material, PermanentMagnet, lookup
from fluxbore.design.winding import electric_loading

UPPER_BOUND = (
    "An upper bound: the iron of the network neither saturates nor takes any magnetomotive force, the flux density is "
    "taken as flat over tau_f + 2 g_ac at the winding's inside though flux is lost on the way to the yoke, and all "
    "leakage is two straight tubes."
)
"""Why equation (2) lies above the finite elements; for reports."""

OVERLAP_ROUNDING = 0.05
"""Share of a pole pitch over which the gap leakage fades out where the rings' tubes meet: no kink for an optimiser."""


@dataclass(frozen=True, slots=True)
class Slots:
    """Slots of a stator with teeth (m). The paper gives none: 2 mm every 4 mm is an assumption of ours."""

    opening: float = 2e-3
    pitch: float = 4e-3


@dataclass(frozen=True, slots=True)
class MagneticNetwork:
    """One solved network. Reluctances in A/Wb, fluxes in Wb, flux densities in T; all without saturation."""

    remanent_mmf: float  # F_rem, A
    magnet_reluctance: float  # R_m
    gap_reluctance: float  # R_g
    shaft_reluctance: float
    gap_leakage_reluctance: float
    leakage_reluctance: float  # R_m', the two before side by side
    effective_gap: float  # g_eff, m
    carter_coefficient: float  # k_c; 1 without slots
    tube_height: float  # tau_f + 2 g_ac, m
    pole_pitch: float  # tau, m
    gap_factor: float  # k_g
    gap_flux: float  # of one magnet through its share of the gap
    gap_flux_density: float  # B_g0, at D_c
    electric_loading: float  # K_sp of 1 A amplitude, A/m per A
    force_constant: float  # F of (2) at 1 A amplitude, N/A; an upper bound, see UPPER_BOUND
    ring_flux_density: float | None  # radial, at D_m of an inner ring, of the gap flux alone; None without rings
    yoke_flux_density: float  # axial, between two rings
    magnet_flux_density: float  # axial, in the magnet
    magnet_field: float  # H in the magnet, A/m; negative, and -H_cJ is the limit

    @property
    def tubes_overlap(self) -> bool:
        """Whether tau_f + 2 g_ac exceeds the pole pitch, so that (1) and (2) no longer hold."""
        return self.tube_height > self.pole_pitch


def network(
    actuator: HybridActuator, library: Library, temperature: float = ROOM_TEMPERATURE, slots: Slots | None = None
) -> MagneticNetwork:
    """The network of this actuator, slotless as it is or with the given slots in a toothed stator.

    temperature : of the magnets (K).

    Slotless, the effective gap is everything between magnets and back yoke, g_ac + t_w and the clearance between
    winding and yoke, since the flux has to cross that too: 4.55 mm in Table II. The paper's g_ac + t_w is 4.15 mm and
    makes B_g0 4 % larger. Slotted it is k_c g_ac, with teeth at D_c in place of the winding.

    Raises MaterialError where a material contradicts the network's picture: a magnetic cylinder, a yoke or rings that
    are not soft iron.
    """
    air_gap = actuator.air_gap
    if slots is None:
        gap, k_c = (actuator.back_yoke.inner_diameter - actuator.mover.outer_diameter) / 2, 1.0
    else:
        k_c = carter_coefficient(air_gap, slots.opening, slots.pitch)
        gap = k_c * air_gap
    return _solved(actuator, _magnetics(actuator, library, temperature), air_gap, gap, k_c)


@dataclass(frozen=True, slots=True)
class CylinderInsertion:
    """The paper's slotted-slotless comparison at one electric loading. Walls in m, force constants in N/A."""

    walls: tuple[float, ...]
    slotted: tuple[float, ...]
    slotless: tuple[float, ...]


def cylinder_insertion(
    actuator: HybridActuator,
    library: Library,
    temperature: float = ROOM_TEMPERATURE,
    slots: Slots | None = None,
    walls: Sequence[float] | None = None,
) -> CylinderInsertion:
    """Force constants of both designs while the air cylinder's wall grows from nothing to the actual one.

    walls : thicknesses (m); by default eleven from 0 to the actual wall.

    Mover, pole pitch and electric loading stay ("the winding characteristics were assumed to remain constant").
    Slotted, the teeth must stay outside the wall: g_ac = g_c + wall. Slotless, there are no teeth: mover and yoke stay
    where they are, and the wall takes the place of air that is no less non-magnetic, layer for layer.
    """
    slots = slots or Slots()
    magnetics = _magnetics(actuator, library, temperature)
    clearance = (actuator.cylinder.inner_diameter - actuator.mover.outer_diameter) / 2
    actual = (actuator.cylinder.outer_diameter - actuator.cylinder.inner_diameter) / 2
    walls = tuple(walls) if walls is not None else tuple(actual * i / 10 for i in range(11))
    outside = (actuator.back_yoke.inner_diameter - actuator.cylinder.outer_diameter) / 2
    slotted, slotless = [], []
    for wall in walls:
        gap = clearance + wall
        k_c = carter_coefficient(gap, slots.opening, slots.pitch)
        slotted.append(_solved(actuator, magnetics, gap, k_c * gap, k_c).force_constant)
        layers = (actuator.air_gap - wall) + wall + outside  # air, wall, winding with its clearance
        slotless.append(_solved(actuator, magnetics, actuator.air_gap, layers, 1.0).force_constant)
    return CylinderInsertion(walls, tuple(slotted), tuple(slotless))


def _solved(actuator: HybridActuator, magnetics: _Magnetics, air_gap: float, gap: float, k_c: float) -> MagneticNetwork:
    """Equations (1) and (2) for an air gap g_ac (m) and an effective gap (m); D_c = D_m + 2 g_ac."""
    mover = actuator.mover
    tau, tau_f, tau_m = mover.pole_pitch, mover.ring_width, actuator.magnet_thickness
    D_m, D_s, D_c = mover.outer_diameter, actuator.shaft.outer_diameter, mover.outer_diameter + 2 * air_gap
    mu_m = MU_0 * magnetics.recoil_permeability
    height = tau_f + 2 * air_gap
    magnet_area = math.pi / 4 * (D_m**2 - D_s**2)

    F_rem = magnetics.remanence * tau_m / mu_m
    R_m = tau_m / (mu_m * magnet_area)
    R_g = math.log1p(2 * gap / D_m) / (2 * math.pi * MU_0 * height)
    R_shaft = tau_m / (MU_0 * magnetics.shaft_permeability * math.pi / 4 * D_s**2)
    free = tau_m - 2 * air_gap
    free = (free + math.hypot(free, OVERLAP_ROUNDING * tau)) / 2
    R_gap_leakage = tau_m**2 / (MU_0 * free * math.pi / 4 * (D_c**2 - D_m**2))
    R_leakage = 1 / (1 / R_shaft + 1 / R_gap_leakage)

    gap_flux = F_rem / (4 * R_g * (R_m / R_leakage + 1) + R_m)
    # k_g / tau_f of (1), written so that it has its limit without rings
    B_g0 = 2 * gap_flux / (math.pi * D_c * height)
    K_sp = electric_loading(actuator, 1.0)
    force = 4 * mover.pole_pairs * D_c * tau * K_sp * B_g0 * math.sin(math.pi / 2 * height / tau)

    ring_drop = 4 * R_g * gap_flux  # from ring to ring, over gap and leakage alike
    yoke_area = math.pi / 4 * (actuator.back_yoke.outer_diameter**2 - actuator.back_yoke.inner_diameter**2)
    return MagneticNetwork(
        remanent_mmf=F_rem,
        magnet_reluctance=R_m,
        gap_reluctance=R_g,
        shaft_reluctance=R_shaft,
        gap_leakage_reluctance=R_gap_leakage,
        leakage_reluctance=R_leakage,
        effective_gap=gap,
        carter_coefficient=k_c,
        tube_height=height,
        pole_pitch=tau,
        gap_factor=tau_f / height,
        gap_flux=gap_flux,
        gap_flux_density=B_g0,
        electric_loading=K_sp,
        force_constant=force,
        ring_flux_density=2 * gap_flux / (math.pi * D_m * tau_f) if tau_f > 1e-9 * tau else None,
        yoke_flux_density=gap_flux / yoke_area,
        magnet_flux_density=(F_rem - ring_drop) / R_m / magnet_area,
        magnet_field=-ring_drop / tau_m,
    )


@dataclass(frozen=True, slots=True)
class _Magnetics:
    """What the network needs of the materials: B_r (T) at temperature and relative permeabilities."""

    remanence: float
    recoil_permeability: float
    shaft_permeability: float


def _magnetics(actuator: HybridActuator, library: Library, temperature: float) -> _Magnetics:
    """The materials' figures at a temperature (K), once all parts fit the network's picture."""
    magnet = lookup(actuator.mover.magnet, "actuator.mover.magnet", library, PermanentMagnet)
    for key, name in (
        ("actuator.back_yoke.material", actuator.back_yoke.material),
        ("actuator.mover.ring_material", actuator.mover.ring_material),
    ):
        if lookup(name, key, library, Material).curve is None:
            raise MaterialError(
                f"{key} must be a soft iron for the magnetic network, which takes it as a perfect conductor of flux; "
                f'got "{name}".'
            )
    key, name = "actuator.cylinder.material", actuator.cylinder.material
    if lookup(name, key, library, Material).relative_permeability > 1.1:
        raise MaterialError(
            f'{key} must be non-magnetic for the magnetic network, which takes it as part of the air gap; got "{name}".'
        )
    shaft = lookup(actuator.shaft.material, "actuator.shaft.material", library, Material)
    return _Magnetics(
        magnet.remanence_at(temperature, actuator.mover.remanence),
        magnet.recoil(actuator.mover.magnet_permeability),
        shaft.relative_permeability,
    )
