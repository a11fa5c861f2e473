"""Network first: the analytic network, corrected wherever the finite elements were asked, proposes every design.

Each step costs one design by the finite elements. The answer is theirs: the surrogate agrees with them in value and
slope at the iterate, a step counts only where they confirm it, and the search ends where their own first-order
conditions hold (trust regions with first-order models: Alexandrov, Dennis, Lewis and Torczon 1998).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from fluxbore.optimize.archive import Archive, BudgetUsedError, TimeUsedError
from fluxbore.optimize.outcome import Limit
from fluxbore.optimize.problem import Merit, Point
from fluxbore.optimize.space_mapping_network import Coarse, Network
from fluxbore.optimize.space_mapping_state import Mapping


@dataclass(frozen=True, slots=True)
class Mapped:
    """How a mapping went.

    reason : a sentence. converged : whether the finite elements' first-order conditions hold.
    fem_designs : asked for by the mapping, those that an earlier run computed included; network_calls : of the network.
    steps : designs that were accepted. residual : of the first-order conditions at the last one, see
    `fluxbore.optimize.optimality.residual`;
    None before there was one. exact : whether all slopes were the model's own, not estimates.
    """

    reason: str
    converged: bool
    fem_designs: int
    network_calls: int
    steps: int
    residual: float | None
    exact: bool


def run_mapping(
    archive: Archive,
    merit: Merit,
    held: Sequence[Limit],
    network: Network,
    start: Point,
    tolerance: float,
    back_off: float = 0.0,
) -> Mapped:
    """Look for the archive's best design, the network corrected by the finite elements proposing each.

    start : scaled point. tolerance : relative, of the objective, as a study gives it; a tenth of it is the least gain
    worth a design. back_off : room to leave to the limits.
    Designs that the archive has already are used as they are. Ends at a used-up budget or time as well and says so;
    what else stops an evaluation (Ctrl-C, a full disk) passes through, with everything found so far in the archive.
    """
    mapping = Mapping(archive, merit, tuple(held), Coarse(network, merit, held, archive.box), tolerance, back_off)
    before = len(archive.history)
    try:
        ending, converged = mapping.run(start)
    except TimeUsedError:
        ending, converged = "The mapping reached its time limit", False
    except BudgetUsedError:
        ending, converged = "The mapping used up its budget of FEM designs", False
    fem = len(archive.history) - before
    residual = None if mapping.centre is None else mapping.residual()
    counted = f"{fem} FEM designs and {mapping.coarse.calls} calls of the network"
    kind = "the finite elements' slopes" if mapping.exact else "estimated slopes"
    how = "" if residual is None else f"KKT residual {residual:.1e} by {kind}; "
    return Mapped(
        f"{ending}; {how}{counted}.", converged, fem, mapping.coarse.calls, mapping.steps, residual, mapping.exact
    )
