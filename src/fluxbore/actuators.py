"""The table of actuators: what each kind offers beyond its figures."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from fluxbore import hybrid_views, hydrostatic_views, lead_screw_views
from fluxbore.design.spec import Spec
from fluxbore.design.title_block import title_block
from fluxbore.fem import femm_coils
from fluxbore.geometry import coils
from fluxbore.geometry.assembly import Assembly
from fluxbore.optimize.benchmark import Benchmark
from fluxbore.optimize.hybrid_contact_force import MCFC
from fluxbore.optimize.hydrostatic_benchmark import TRACKING
from fluxbore.optimize.lead_screw_benchmark import FORCE
from fluxbore.reports.kind_words import PLAIN, WORDS, KindWords

if TYPE_CHECKING:
    from fluxbore.fem.femm_model import FemmModel
    from fluxbore.optimize.evaluation import Evaluation
    from fluxbore.reports.content import FluxMap, SlotComparison
    from fluxbore.reports.hydrostatic_content import HydraulicsContent
    from fluxbore.reports.lead_screw_content import ScrewContent


@dataclass(frozen=True, slots=True)
class Actuator:
    """The verbs of one kind of actuator.

    assembly : its parts with the mover at a share of its stroke, 0 to 1; see `assembly_of`. words : what its report
    calls things.
    flux_map : its field at no current, for a picture. slots : the slotted-slotless comparison. femm_model : its
    cross-section as a FEMM model. benchmarks : the experiments in simulated time that it can be put through, by name.
    screw : what a report shows of a magnetic lead screw alone, with its evaluation by finite elements. hydraulics :
    the same of an electro-hydrostatic actuator, with its evaluation by simulation.
    What a kind does not have is None, or empty.
    """

    assembly: Callable[[Spec, float], Assembly]
    words: KindWords = PLAIN
    flux_map: Callable[[Spec], FluxMap | None] | None = None
    slots: Callable[[Spec], SlotComparison | None] | None = None
    femm_model: Callable[[Spec], FemmModel] | None = None
    benchmarks: Mapping[str, Benchmark] = field(default_factory=dict)
    screw: Callable[[Spec, Evaluation], ScrewContent | None] | None = None
    hydraulics: Callable[[Spec, Evaluation], HydraulicsContent | None] | None = None


ACTUATORS: dict[str, Actuator] = {
    "coils": Actuator(coils.assembly, WORDS["coils"], femm_model=femm_coils.femm_model),
    "hybrid": Actuator(
        hybrid_views.assembly,
        WORDS["hybrid"],
        hybrid_views.flux_map,
        hybrid_views.slot_comparison,
        hybrid_views.femm_model,
        {MCFC.name: MCFC},
    ),
    "hydrostatic": Actuator(
        hydrostatic_views.assembly,
        WORDS["hydrostatic"],
        benchmarks={TRACKING.name: TRACKING},
        hydraulics=hydrostatic_views.hydraulics,
    ),
    "lead-screw": Actuator(
        lead_screw_views.assembly,
        WORDS["lead-screw"],
        benchmarks={FORCE.name: FORCE},
        screw=lead_screw_views.screw_content,
    ),
}
"""Every kind of actuator by its name in the specification."""


MID_STROKE = 0.5

STROKE_PLACES = {"mid-stroke": MID_STROKE, "retracted": 0.0, "extended": 1.0}
"""Where CAD files show the mover: the share of its stroke."""


def assembly_of(spec: Spec, place: float = MID_STROKE) -> Assembly:
    """The parts with the mover at a share of its stroke, and with the specification's numbers and names.

    Raises DesignError where the parts do not fit one another.
    """
    return replace(actuator_of(spec).assembly(spec, place), title=title_block(spec.values))


def actuator_of(spec: Spec) -> Actuator:
    """The verbs of the specification's kind."""
    return ACTUATORS[spec.kind.name]
