"""The keys of a piston's seal: the friction law of Nakata and Noda (2023), Table IV."""

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
        "contact force of mover and stator without pressure",
        dimension="force",
        symbol="F_0",
        minimum=0.0,
        maximum=1e6,
        default=20.5,
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
)
