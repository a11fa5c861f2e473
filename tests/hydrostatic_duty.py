"""The PREHydrA's duty sized by hand: the study's optimum in closed form, without a search and without the network.

Each limit that binds fixes one variable, and the distal mass grows with each of them: the springs' rate is the start's
(force over the stroke), the bore bears 480 N and its seal's friction at 70 bar, the wall has the start's ratio to the
bore (Lame), the rod is Euler's with a factor of three, the lead makes up for the ratio of areas, and the hose is the
narrowest.
"""

import math

OUT = "actuator.output_cylinder"
LEAD, HOSE, RATE = "actuator.ball_screw.lead", "actuator.hose.bore", "actuator.return_spring.rate"

PUSHED = 480.0
"""N, that the study asks for."""


def sized() -> dict[str, float]:
    """The variables, SI."""
    speed = 592 * 5e-3 / math.tau
    friction = 8.1 + 4.2e-6 * 7e6 + 15.3 * math.exp(-118.5 * speed) + 59.5 * speed
    area = (PUSHED + friction) / 7e6
    bore = math.sqrt(4 / math.pi * area)
    rod = (3 * area * 7e6 * (2 * 0.1524) ** 2 * 64 / (math.pi**3 * 193e9)) ** 0.25
    return {
        f"{OUT}.bore": bore,
        f"{OUT}.wall_thickness": 0.8e-3 * bore / 14.3e-3,
        f"{OUT}.rod_diameter": rod,
        LEAD: 5e-3 * (bore / 14.3e-3) ** 2,
        HOSE: 3.2e-3,
        RATE: 2840.0,
    }
