"""What a search along a front sees of a design: both losses and the misses of the limits, with their gradients."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

from fluxbore.design.spec import Spec
from fluxbore.optimize.outcome import Candidate, Limit
from fluxbore.optimize.pareto_scalar import Scale, Seen
from fluxbore.optimize.problem import Box, Merit
from fluxbore.optimize.slopes import NoSlopesError, Slopes


@dataclass(frozen=True, slots=True)
class Sight:
    """How designs of one study are seen.

    held : the limits that the search must hold; those on variables are in the box already.
    room : to leave to them (relative), so that what closes in on a limit from both sides ends up feasible.
    gradients : whether designs bring derivatives.
    """

    base: Spec
    box: Box
    scale: Scale
    held: tuple[Limit, ...]
    room: float
    gradients: bool

    def see(self, design: Candidate, kappas: Mapping[str, float]) -> Seen | None:
        """The design as numbers; None where it lacks a figure that they need.

        kappas : figure -> maximum over norm, as of `fluxbore.optimize.slopes`. Raises NoSlopesError.
        """
        losses = self.scale.losses(design)
        if losses is None:
            return None
        if not self.gradients:
            margins = {item.limit: item.margin for item in design.checks}
            misses = [math.inf if (m := margins.get(limit)) is None else self.room - m for limit in self.held]
            return Seen(losses, tuple(misses)) if all(math.isfinite(x) for x in (*losses, *misses)) else None
        figures = self.scale.figures(design) or ()
        first, second = (
            slopes.view(replace(design, objective=figure), kappas)
            for slopes, figure in zip(self._slopes(), figures, strict=True)
        )
        if first is None or second is None:
            return None
        (one, other), (r_u, r_v) = self.scale.origin, self.scale.span
        seen = Seen(
            ((first.loss - one) / r_u, (second.loss - other) / r_v),
            tuple(miss + self.room for miss in first.misses),
            (tuple(slope / r_u for slope in first.slope), tuple(slope / r_v for slope in second.slope)),
            first.miss_slopes,
        )
        return seen if all(math.isfinite(x) for x in (*seen.losses, *seen.misses)) else None

    def kappas(self, design: Candidate) -> dict[str, float]:
        """Maximum over norm of the problem's figures that have a norm, at this design."""
        first, second = self._slopes()
        return first.kappas(design) | second.kappas(design)

    def has_slopes(self, design: Candidate) -> bool:
        """Whether the design brings every derivative that the search needs; True where it has no figures at all."""
        try:
            self.see(design, self.kappas(design))
        except NoSlopesError:
            return False
        return True

    def _slopes(self) -> tuple[Slopes, Slopes]:
        first, second = (Slopes(self.base, self.box, Merit(item, 1.0), self.held) for item in self.scale.objectives)
        return first, second
