"""The keys of a piston's seal: the friction law of Nakata and Noda (2023), Table IV, and what makes its fin."""

from __future__ import annotations

from fluxbore.design.keys import Key

SEAL_KEYS: tuple[Key, ...] = (
    Key(
        "actuator.seal.static_coefficient",
        "static friction coefficient of seal and bore",
        kind="number",
        symbol="mu_S",
        minimum=0.0,
        maximum=10.0,
        default=0.182,
    ),
    Key(
        "actuator.seal.coulomb_coefficient",
        "Coulomb friction coefficient of seal and bore",
        kind="number",
        symbol="mu_C",
        minimum=0.0,
        maximum=10.0,
        default=0.127,
    ),
    Key(
        "actuator.seal.contact_force",
        "measured contact force of mover and stator without pressure; without it that of the two lips, which follows "
        "the fin's shape, and guide_force",
        dimension="force",
        symbol="F_0",
        minimum=0.0,
        maximum=1e6,
        optional=True,
    ),
    Key(
        "actuator.seal.guide_force",
        "contact force of mover and stator elsewhere than at the lips; not beside a measured contact_force",
        dimension="force",
        minimum=0.0,
        maximum=1e6,
        default=0.0,
    ),
    Key(
        "actuator.seal.stribeck_speed",
        "speed at which static friction has given way",
        dimension="speed",
        symbol="v_s",
        above=0.0,
        maximum=100.0,
        default=0.00132,
    ),
    Key(
        "actuator.seal.viscous_coefficient",
        "friction that grows with speed",
        dimension="viscous friction",
        symbol="sigma_2",
        minimum=0.0,
        maximum=1e6,
        default=0.0,
    ),
    Key(
        "actuator.seal.roughness",
        "rms roughness of bore and lip together, for the air leakage",
        above=0.0,
        maximum=1e-4,
        default=0.4e-6,
    ),
    Key(
        "actuator.seal.roughness_wavelength",
        "longest wavelength of that roughness",
        above=0.0,
        maximum=1e-2,
        default=0.1e-3,
    ),
    Key(
        "actuator.seal.specific_wear",
        "volume that the lip loses per force and distance",
        dimension="specific wear",
        above=0.0,
        maximum=1e-9,
        default=1e-16,
    ),
)

FIN_KEYS: tuple[Key, ...] = (
    Key(
        "actuator.piston.fin_tolerance",
        "fin tolerance, the total width of the field in whose middle fin_outer_diameter lies",
        minimum=0.0,
        maximum=1e-2,
        default=0.043e-3,
    ),
    Key(
        "actuator.piston.fin_material",
        "material of the seal fin's lip: its stiffness, strength and expansion; without it the piston's",
        kind="word",
        optional=True,
    ),
    Key(
        "actuator.piston.fin_modulus",
        "Young's modulus of the lip; without it its material's",
        dimension="stress",
        symbol="E",
        above=0.0,
        maximum=1e12,
        optional=True,
    ),
)
