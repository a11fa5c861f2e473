"""What a material is: soft iron, permanent magnet, conductor or structural, each as frozen data in SI units."""

from __future__ import annotations

from dataclasses import dataclass

from fluxbore.design.bh_curve import BHCurve
from fluxbore.design.errors import MaterialError
from fluxbore.design.units import ZERO_CELSIUS

ROOM_TEMPERATURE = 20.0 + ZERO_CELSIUS
"""K, the temperature at which materials are tabulated."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Material:
    """What all materials share. ``None`` stands for a datum that is not known, never for zero.

    density : kg/m^3.   young_modulus, yield_stress : Pa.   poisson_ratio : plain number.
    thermal_expansion : 1/K, of a length, around 20 degC.
    thermal_conductivity : W/(m K).   resistivity : ohm m at 20 degC; None of an insulator too.
    curve : the B-H curve of a soft iron, None of all others.
    """

    name: str
    density: float
    source: str
    young_modulus: float | None = None
    poisson_ratio: float | None = None
    yield_stress: float | None = None
    thermal_conductivity: float | None = None
    thermal_expansion: float | None = None
    resistivity: float | None = None
    curve: BHCurve | None = None

    @property
    def relative_permeability(self) -> float:
        """For linear models. 1 of non-magnetic materials; of a soft iron the largest that its curve reaches."""
        return 1.0 if self.curve is None else self.curve.maximum_permeability


@dataclass(frozen=True, slots=True, kw_only=True)
class SoftIron(Material):
    """A material with a B-H curve, which leaves hysteresis out; its loss is Steinmetz's k_h f B^n in each volume.

    hysteresis_coefficient : k_h (J/m^3), of one cycle at 1 T; None where it is not known.   hysteresis_exponent : n.
    """

    curve: BHCurve
    hysteresis_coefficient: float | None = None
    hysteresis_exponent: float = 1.6


@dataclass(frozen=True, slots=True, kw_only=True)
class PermanentMagnet(Material):
    """A rare-earth magnet with a straight recoil line B = B_r + mu_0 mu_r H down to its intrinsic coercivity.

    remanence : B_r at 20 degC (T).   intrinsic_coercivity : H_cJ at 20 degC (A/m, positive).
    remanence_coefficient, coercivity_coefficient : relative change per kelvin (1/K), both negative as a rule.
    working_temperature : K, up to which the coefficients are stated; None where it is not known.
    """

    remanence: float
    remanence_coefficient: float = 0.0
    intrinsic_coercivity: float
    coercivity_coefficient: float = 0.0
    recoil_permeability: float = 1.05
    working_temperature: float | None = None

    @property
    def relative_permeability(self) -> float:
        """mu_r of the recoil line."""
        return self.recoil_permeability

    def remanence_at(self, temperature: float, remanence_20: float | None = None) -> float:
        """B_r (T) at a temperature (K): B_r(20 degC) (1 + alpha (T - 20 degC)), IEC 60404-5.

        remanence_20 : a measured remanence at 20 degC (T) in place of the grade's.
        Valid from 20 degC to the working temperature. Raises MaterialError where nothing would be left of it.
        """
        base = self.remanence if remanence_20 is None else remanence_20
        return self._scaled(base, self.remanence_coefficient, temperature, "remanence")

    def coercivity_at(self, temperature: float) -> float:
        """H_cJ (A/m) at a temperature (K), by its own coefficient; a field of -H_cJ demagnetises the magnet.

        Valid from 20 degC to the working temperature. Raises MaterialError where nothing would be left of it.
        """
        return self._scaled(self.intrinsic_coercivity, self.coercivity_coefficient, temperature, "coercivity")

    def recoil(self, measured: float | None = None) -> float:
        """mu_r of the recoil line: a measured one in place of the grade's."""
        return self.recoil_permeability if measured is None else measured

    def _scaled(self, base: float, coefficient: float, temperature: float, what: str) -> float:
        factor = 1.0 + coefficient * (temperature - ROOM_TEMPERATURE)
        if not factor > 0.0:
            raise MaterialError(
                f'The {what} of "{self.name}" must stay above zero, which its temperature coefficient '
                f"{coefficient * 100:.3g} %/K allows up to {ROOM_TEMPERATURE - 1.0 / coefficient - ZERO_CELSIUS:.0f} "
                f"degC; got {temperature - ZERO_CELSIUS:.0f} degC."
            )
        return base * factor


@dataclass(frozen=True, slots=True, kw_only=True)
class Conductor(Material):
    """A material of windings.

    resistivity : ohm m at 20 degC.   temperature_coefficient : its relative change per kelvin there (1/K).
    """

    resistivity: float
    temperature_coefficient: float = 0.0

    def resistivity_at(self, temperature: float) -> float:
        """rho (ohm m) at a temperature (K): rho_20 (1 + alpha (T - 20 degC)), IEC 60028; good from -50 to 200 degC.

        Raises MaterialError where the straight line has fallen to zero.
        """
        factor = 1.0 + self.temperature_coefficient * (temperature - ROOM_TEMPERATURE)
        if not factor > 0.0:
            raise MaterialError(
                f'The resistivity of "{self.name}" must stay above zero, and its straight line in temperature does not '
                f"at {temperature - ZERO_CELSIUS:.0f} degC."
            )
        return self.resistivity * factor


@dataclass(frozen=True, slots=True, kw_only=True)
class Structural(Material):
    """A non-magnetic material."""


def describe(kind: type[Material]) -> str:
    """A kind as a sentence would call it."""
    words = {
        SoftIron: "soft iron",
        PermanentMagnet: "permanent magnet",
        Conductor: "conductor",
        Structural: "structural material",
    }
    return words.get(kind, "material")
