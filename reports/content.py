"""What a report says: everything the page needs, gathered before the first line of it is written.

The page computes no physics. What is absent (None or empty) is left out of the page, or the page says why.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.spec import Spec
from fluxbore.design.winding_chart import WindingChart
from fluxbore.geometry.assembly import Assembly
from fluxbore.optimize.benchmark import BenchmarkResult
from fluxbore.optimize.evaluation import Evaluation
from fluxbore.optimize.outcome import Candidate, Check, SearchResult, SweepResult
from fluxbore.optimize.pareto_result import ParetoResult
from fluxbore.optimize.tolerance_result import RobustResult, ToleranceResult
from fluxbore.reports.hydrostatic_content import HydraulicsContent
from fluxbore.reports.kind_words import PLAIN, KindWords
from fluxbore.reports.lead_screw_content import ScrewContent

if TYPE_CHECKING:
    from fluxbore.fem.field_loads import Load

Array = NDArray[np.float64]
Triangles = NDArray[np.int_]


@dataclass(frozen=True, slots=True, eq=False)
class FluxMap:
    """The field of one design at one position of the mover and no current. SI units.

    r, z : (n,) node coordinates (m).
    triangles : (m, 3) node numbers; quadratic elements are given as four linear ones.
    flux : (n,) psi = r A_phi (Wb/rad); its level lines are field lines.
    flux_density : |B| (T), (n,) at the nodes or (m,) in the triangles; the latter keeps jumps at material boundaries.
    outlines : name and (k, 2) polygon of (r, z) (m) of every part to be drawn over the field.
    position : of the mover (m).
    region : (m,) number of the material region of each triangle; with it field lines are drawn smooth within each.
    components : (m, 2) B_r, B_z (T) in the triangles, for the pointer to read; None where there is nothing to read.
    loads : of iron and magnets in this field, against what their materials bear.
    """

    r: Array
    z: Array
    triangles: Triangles
    flux: Array
    flux_density: Array
    outlines: tuple[tuple[str, Array], ...]
    position: float
    region: Triangles | None = None
    components: Array | None = None
    loads: tuple[Load, ...] = ()


@dataclass(frozen=True, slots=True)
class PartRow:
    """One line of the parts list; parts of the same shape and name share a line by their ``count``.

    size : the part's main dimensions in words, for people. volume (m^3) and mass (kg) are of one piece. source :
    "make" or "buy", with the ``designation`` that it is ordered by; what is drawn by nobody has no number,
    neither of its own nor on the list.
    """

    name: str
    group: str
    material: str
    size: str
    volume: float
    mass: float
    count: int = 1
    part_number: str = ""
    source: str = ""
    designation: str = ""
    number: int = 0


@dataclass(frozen=True, slots=True)
class SlotComparison:
    """Force constants by equation (2) as a cylinder is put between mover and winding.

    wall_thickness : of the cylinder (m). slotted, slotless : force constants (N/A), one for each thickness.
    note : what was held, and what was assumed of the slots.
    """

    wall_thickness: tuple[float, ...]
    slotted: tuple[float, ...]
    slotless: tuple[float, ...]
    note: str = ""


@dataclass(frozen=True, slots=True)
class Picture:
    """A rendered picture (PNG), or the reason why there is none."""

    png: bytes | None
    reason: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class ReportContent:
    """Everything a report can show. Only ``spec`` is needed.

    spec : the start design with its study. chosen_spec : the design to make; None where nothing was chosen.
    start, chosen : their evaluations by finite elements.
    start_network, chosen_network : their evaluations by the magnetic network.
    search : the search from beginning to end; its chosen candidate is ``chosen``.
    checks : the limits held against the chosen design (else the start) where there was no search; with a search its
        own checks are shown.
    one_at_a_time : the best of each variable's own sweep put together, evaluated.
    slots : the slotted-slotless comparison by the network.
    winding : the chart of its coils, where it has any.
    assembly : the design's parts where they stand; drawn in section. model : the same as GLB, for the live view.
    checked, not_checked : sentences; what the page itself can see (residuals, the two routes) it adds.
    provenance : label -> text: versions, hashes, date, mesh, command.
    seconds : wall time of the whole run.
    words : what the actuator's kind calls things.
    front, tolerance, robust : what the study asked for besides a search.
    simulation : the benchmark in simulated time that the design was put through.
    screw : what only a magnetic lead screw has. hydraulics : what only an electro-hydrostatic actuator has.
    """

    spec: Spec
    chosen_spec: Spec | None = None
    start: Evaluation | None = None
    chosen: Evaluation | None = None
    start_network: Evaluation | None = None
    chosen_network: Evaluation | None = None
    search: SearchResult | None = None
    checks: tuple[Check, ...] = ()
    sweeps: tuple[SweepResult, ...] = ()
    one_at_a_time: Candidate | None = None
    flux_map: FluxMap | None = None
    start_flux_map: FluxMap | None = None
    slots: SlotComparison | None = None
    parts: tuple[PartRow, ...] = ()
    assembly: Assembly | None = None
    winding: WindingChart | None = None
    picture: Picture | None = None
    model: bytes | None = None
    checked: tuple[str, ...] = ()
    not_checked: tuple[str, ...] = ()
    provenance: Mapping[str, str] = field(default_factory=dict)
    seconds: float | None = None
    words: KindWords = PLAIN
    front: ParetoResult | None = None
    tolerance: ToleranceResult | None = None
    robust: RobustResult | None = None
    simulation: BenchmarkResult | None = None
    screw: ScrewContent | None = None
    hydraulics: HydraulicsContent | None = None

    @property
    def design_spec(self) -> Spec:
        """The specification of the design that the report is about: the chosen one, else the start."""
        return self.chosen_spec or self.spec

    @property
    def design(self) -> Evaluation | None:
        """The evaluation of that design."""
        return self.chosen if self.chosen_spec is not None else self.start

    @property
    def design_network(self) -> Evaluation | None:
        return self.chosen_network if self.chosen_spec is not None else self.start_network

    @property
    def is_study(self) -> bool:
        """Whether a design was chosen that can be set beside the start."""
        return self.chosen_spec is not None

    @property
    def design_checks(self) -> tuple[Check, ...]:
        """The limits held against that design."""
        if self.search is None:
            return self.checks
        if not self.is_study:
            return self.search.start.checks
        return self.search.chosen.checks if self.search.chosen is not None else self.checks
