"""Size, seconds and memory of reports, and how they move on a slow laptop: `python benchmarks/report.py [--runs 3]`.

Each report of the examples is built in a process of its own, as a user does it, and opened in a headless chromium of
its own without a network and without a graphics card: the processor draws. Told are medians. For the slow laptop the
page's processor is slowed down four times, and the script's heap is held to 512 MB; the memory of all of chromium's
processes together is what such a machine has to give. Needs chromium and Linux.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path
from statistics import median

TOP = Path(__file__).parents[1]
sys.path.insert(0, str(TOP / "tests"))

from browser.chromium import Chromium  # noqa: E402
from browser.memory import resident  # noqa: E402
from browser.page import Page  # noqa: E402

REPORTS = {
    "hybrid": ("ipehla",),
    "lead screw": ("rotlin",),
    "hydrostatic": ("prehydra",),
    "coils": ("team22-published",),
    "three hybrids side by side": ("ipehla", "ipehla-optimum", "ipehla-tolerance"),
}

SLOWER = 4.0
"""Times, of the slow laptop's processor."""

HEAP = 512
"""MB of the scripts' heap there."""

STEP, FRAMES = 90, 120
"""CSS pixels and frames of the scroll that is timed."""

TURNS = 40
"""Moves of the pointer that turn the live view."""

RECORD = """(() => { const times = window.frameTimes = []; let last = performance.now(); window.recording = true;
const next = now => { times.push(now - last); last = now; if (window.recording) requestAnimationFrame(next); };
requestAnimationFrame(next); })()"""

SCROLL = f"""new Promise(done => {{ let left = {FRAMES}; const next = () => {{
window.scrollBy({{top: {STEP}, behavior: 'instant'}}); if (left-- > 0) requestAnimationFrame(next); else done(1); }};
requestAnimationFrame(next); }})"""


@dataclass(frozen=True, slots=True)
class Look:
    """One look at a page: seconds until it is loaded and until its view is drawn, bytes of the scripts' heap and of all
    processes, milliseconds a frame while it scrolls and turns (median, and the longest but for one in twenty)."""

    load: float
    drawn: float
    heap: float
    memory: float
    scroll: tuple[float, float]
    turn: tuple[float, float] | None


def build(specs: tuple[str, ...], page: Path) -> tuple[float, float]:
    """Write a report; seconds by the clock and of the processor."""
    files = [str(TOP / "examples" / f"{name}.toml") for name in specs]
    command = [sys.executable, "-m", "fluxbore", "report", *files, "-o", str(page), "--force"]
    began, before = time.monotonic(), os.times()
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if not page.exists():
        raise SystemExit(done.stderr)
    after = os.times()
    cpu = after.children_user + after.children_system - before.children_user - before.children_system
    return time.monotonic() - began, cpu


def look(page: Path, *, slow: bool) -> Look:
    options = ["--enable-precise-memory-info", *([f"--js-flags=--max-old-space-size={HEAP}"] if slow else [])]
    with Chromium(options) as chromium:
        began = time.monotonic()
        with chromium.open(page, slower=SLOWER if slow else 1.0) as shown:
            loaded = shown.evaluate("performance.getEntriesByType('navigation')[0].loadEventEnd / 1e3")
            shown.wait("[...document.querySelectorAll('[data-live]')].every(e => e.dataset.live)")
            shown.settle()
            drawn = time.monotonic() - began
            scroll, turn = _scrolled(shown), _turned(shown)
            heap = shown.evaluate("performance.memory.usedJSHeapSize")
            return Look(loaded, drawn, heap, resident(chromium.process.pid)[1], scroll, turn)


def _scrolled(page: Page) -> tuple[float, float]:
    page.evaluate(RECORD)
    page.evaluate(SCROLL, limit=120.0)
    return _frames(page)


def _turned(page: Page) -> tuple[float, float] | None:
    if not page.evaluate("Boolean(document.querySelector('.stage canvas'))"):
        return None
    x, y = page.middle(".stage canvas")
    page.settle()
    page.evaluate(RECORD)
    page.drag((x - 100, y), (x + 100, y + 20), TURNS)
    page.settle()
    return _frames(page)


def _frames(page: Page) -> tuple[float, float]:
    times = sorted(page.evaluate("(window.recording = false, window.frameTimes.slice(1))"))
    return median(times), times[int(0.95 * (len(times) - 1))]


def _row(name: str, size: float, built: list[tuple[float, float]], looks: list[Look]) -> str:
    def middle(values: list[float], factor: float = 1.0, decimals: int = 1) -> str:
        return f"{median(values) * factor:.{decimals}f}"

    def frames(pairs: list[tuple[float, float]]) -> str:
        return " / ".join(middle([pair[i] for pair in pairs], decimals=0) for i in (0, 1)) if pairs else "–"

    cells = [
        name,
        f"{size / 1e3:.0f}",
        *(middle([run[i] for run in built]) for i in (0, 1)),
        middle([item.load for item in looks], decimals=2),
        middle([item.drawn for item in looks], decimals=2),
        middle([item.heap for item in looks], 1e-6, 0),
        middle([item.memory for item in looks], 1e-6, 0),
        frames([item.scroll for item in looks]),
        frames([item.turn for item in looks if item.turn is not None]),
    ]
    return f"| {' | '.join(cells)} |"


HEAD = (
    "| report | kB | s to build | of the processor | s to load | s to draw | heap, MB | all processes, MB | "
    "ms a frame, scrolling | turning |\n|---|---|---|---|---|---|---|---|---|---|"
)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition(":")[0])
    parser.add_argument("--runs", type=int, default=3)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        pages = {name: Path(folder) / f"{name}.html" for name in REPORTS}
        built = {name: [build(specs, pages[name]) for _ in range(options.runs)] for name, specs in REPORTS.items()}
        for slow in (False, True):
            print(
                f"\n{'A slow laptop' if slow else 'This machine'}, median of {options.runs} (frames: median / 95 %)\n"
            )
            print(HEAD, flush=True)
            for name, page in pages.items():
                looks = [look(page, slow=slow) for _ in range(options.runs)]
                print(_row(name, page.stat().st_size, built[name], looks), flush=True)


if __name__ == "__main__":
    main()
