"""What a benchmark in simulated time is, and what comes of putting designs through it, whatever their kind."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fluxbore.design.keys import Value
from fluxbore.design.spec import Spec
from fluxbore.optimize.evaluation import OK, Evaluation

if TYPE_CHECKING:
    from fluxbore.design.dynamics.simulation import Simulation


@dataclass(frozen=True, slots=True)
class Published:
    """A benchmark's figure beside the one that a source gives.

    path : of the figure in `Simulation.figures`. label : in words. dimension : of `fluxbore.design.units`, "fraction"
    or "count". value : as published (SI), None where the source gives none. within : the difference (SI) up to which
    the figure counts as reproduced. note : where the published value stands, or how it follows. least, most : the
    figure counts as reproduced from the one and up to the other (SI).
    """

    path: tuple[str, ...]
    label: str
    dimension: str
    value: float | None = None
    within: float | None = None
    note: str = ""
    least: float | None = None
    most: float | None = None

    def of(self, figures: Mapping[str, Any]) -> float | None:
        """The figure itself; None where the simulation has none."""
        found: Any = figures
        for name in self.path:
            found = found.get(name) if isinstance(found, Mapping) else None
        return None if found is None else float(found)

    def reproduced(self, figures: Mapping[str, Any]) -> bool | None:
        """Whether the figure is where it should be; None where there is nothing to hold it against."""
        found = self.of(figures)
        held = self.value is not None and self.within is not None
        if found is None or not (held or self.least is not None or self.most is not None):
            return None
        return (
            (self.value is None or self.within is None or abs(found - self.value) <= self.within)
            and (self.least is None or found >= self.least)
            and (self.most is None or found <= self.most)
        )

    def limits(self, show: Callable[[float], str]) -> str:
        """What it takes to be reproduced, in words: "within 2 N", "at least 1.4, at most 2"; empty for nothing."""
        words = (("within", self.within), ("at least", self.least), ("at most", self.most))
        return ", ".join(f"{word} {show(value)}" for word, value in words if value is not None)


@dataclass(frozen=True, slots=True)
class Benchmark:
    """An experiment in simulated time that one kind of actuator can be put through.

    name : on the command line, and that of its section of keys, ``benchmark.mcfc``. title : what it is, in words.
    source : whose experiment it is. designs : of a design, those around it, by their values, whose evaluations show
    the field that the simulation moves through. field : what the simulation takes of those evaluations. simulate : one
    seed, with traces or without; a worker finds it by its name, so it stands in a module. published : the figures that
    a table shows. causes : what of a design its results come from, which makes those of two designs differ. limits :
    what agreement with the source does not show, in sentences. variations : of a design and its field, other values of
    keys that leave the field as it is, each with what it is called. random : whether its trials are drawn by chance, so
    that one seed differs from another. own : leaves of its keys that describe a design and not the test stand.
    usual_seeds : how many are drawn where their number is not given.
    """

    name: str
    title: str
    source: str
    designs: Callable[[Spec], Sequence[Mapping[str, Value]]]
    field: Callable[[Spec, Sequence[Evaluation]], Any]
    simulate: Callable[[Spec, Any, int, bool], Simulation]
    published: tuple[Published, ...] = ()
    causes: tuple[Published, ...] = ()
    limits: tuple[str, ...] = ()
    variations: Callable[[Spec, Any], Sequence[tuple[str, Mapping[str, Value]]]] = lambda spec, field: ()
    random: bool = True
    own: tuple[str, ...] = ()
    usual_seeds: int = 5

    @property
    def section(self) -> str:
        """The dotted prefix of its keys."""
        return f"benchmark.{self.name}."


@dataclass(frozen=True, slots=True, eq=False)
class DesignRun:
    """One design put through a benchmark.

    label : what it is called beside others. evaluation : of the design as it is. field : what `Benchmark.field` made.
    simulations : by seed, in the order asked for; the first of the study's own design holds its traces. figures : the
    median of each over the seeds. reasons : why there are none, in sentences.
    """

    label: str
    spec: Spec
    evaluation: Evaluation
    field: Any
    simulations: tuple[Simulation, ...]
    figures: Mapping[str, Any]
    status: str
    reasons: tuple[str, ...] = ()

    @property
    def ok(self) -> bool:
        return self.status == OK


@dataclass(frozen=True, slots=True, eq=False)
class BenchmarkResult:
    """A benchmark's runs: of the specification's own design, and of those that it is set against.

    variations : the specification's own design under other conditions, the first seed alone, where they were asked for.
    reused : simulations that had not to be computed. files : what was written.
    """

    benchmark: Benchmark
    seeds: tuple[int, ...]
    run: DesignRun
    against: tuple[DesignRun, ...] = ()
    variations: tuple[DesignRun, ...] = ()
    reused: int = 0
    files: tuple[Path, ...] = ()

    @property
    def ok(self) -> bool:
        return self.run.ok

    @property
    def runs(self) -> tuple[DesignRun, ...]:
        """Those of all designs, the specification's own first."""
        return (self.run, *self.against)

    @property
    def moved(self) -> tuple[Published, ...]:
        """The published figures that any variation changes; one that it leaves out is not changed."""
        first = self.run.simulations[0].figures
        return tuple(
            item
            for item in self.benchmark.published
            if any(run.ok and item.of(run.figures) not in (None, item.of(first)) for run in self.variations)
        )
