"""The progress line on stderr."""

from __future__ import annotations

import sys
import time
from collections.abc import Mapping
from types import TracebackType
from typing import Self

from fluxbore.design.performance import show_figure
from fluxbore.optimize.progress import Progress
from fluxbore.value_text import short_names, show_subject

SECONDS_BETWEEN_LINES = 5.0
"""Between progress lines where stderr is a file; a terminal gets one line that is written over."""


class Bar:
    """Progress on stderr."""

    def __init__(self, quiet: bool) -> None:
        self._quiet = quiet
        self._terminal = sys.stderr.isatty()
        self._last = 0.0
        self._width = 0

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._width:
            sys.stderr.write("\n")
            self._width = 0

    def say(self, sentence: str) -> None:
        """A sentence of its own line, quiet or not."""
        if self._width:
            sys.stderr.write("\n")
            self._width = 0
        sys.stderr.write(f"fluxbore: {sentence}\n")

    def show(self, progress: Progress) -> None:
        """One more design is done."""
        now = time.monotonic()
        last = progress.done >= progress.total
        if self._quiet or not (last or self._terminal or now - self._last >= SECONDS_BETWEEN_LINES):
            return
        self._last = now
        line = _line(progress)
        if self._terminal:
            sys.stderr.write("\r" + line.ljust(self._width) + ("\n" if last else ""))
            self._width = 0 if last else len(line)
        else:
            sys.stderr.write(line + "\n")
        sys.stderr.flush()


def _line(progress: Progress) -> str:
    parts = [f"{progress.label} {progress.done}/{progress.total}"]
    if progress.reused:
        parts.append(f"{progress.reused} from the journal")
    if progress.failed:
        parts.append(f"{progress.failed} failed")
    if progress.rate is not None:
        parts.append(_pace(progress.rate))
    if progress.seconds_left is not None and progress.done < progress.total:
        parts.append(f"{'at most ' * progress.at_most}{_duration(progress.seconds_left)} left")
    if progress.best is not None and progress.figure is not None:
        parts.append(f"best {show_figure(progress.figure, progress.best)}{_at(progress.best_values)}")
    return ", ".join(parts)


def _pace(rate: float) -> str:
    """Designs per second or, where they take longer, seconds per design."""
    return f"{rate:.3g} a second" if rate >= 1 else f"{1 / rate:.3g} s each"


def _duration(seconds: float) -> str:
    """As a person says it: 45 s, 12 min, 3 h 20 min."""
    minutes = round(seconds / 60)
    if seconds < 100:
        return f"{seconds:.0f} s"
    return f"{minutes} min" if minutes < 100 else f"{minutes // 60} h {minutes % 60} min"


def _at(values: Mapping[str, float] | None) -> str:
    if not values:
        return ""
    short = short_names(values)
    return " at " + ", ".join(f"{short[key]} {show_subject(key, value)}" for key, value in values.items())
