"""Seconds and sizes of every export format, and of all at once: `python benchmarks/exports.py [SPEC] [--runs 3]`.

Each run is a process of its own, as a user starts it, so that importing the CAD kernel and matplotlib counts. The
median of the runs is told, with the processor's seconds beside those of the clock: the first do not suffer from what
else the machine does.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from statistics import median

from fluxbore.design.spec import load
from fluxbore.exporting import wanted

TOP = Path(__file__).parents[1]


def export(spec: Path, word: str) -> tuple[float, float, int, int]:
    """Seconds by the clock and of the processor, and the files' number and bytes, of one run."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "out"
        command = [sys.executable, "-m", "fluxbore", "export", str(spec), "-o", str(out), "--format", word]
        began, before = time.monotonic(), os.times()
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        after = os.times()
        cpu = after.children_user + after.children_system - before.children_user - before.children_system
        files = [path for path in out.rglob("*") if path.is_file() and not path.name.startswith((".", "journal"))]
        return time.monotonic() - began, cpu, len(files), sum(path.stat().st_size for path in files)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition(":")[0])
    parser.add_argument("spec", nargs="?", type=Path, default=TOP / "examples" / "ipehla.toml")
    parser.add_argument("--runs", type=int, default=3)
    options = parser.parse_args()
    print(f"{options.spec.name}, median of {options.runs} runs\n")
    print("| format | seconds | of the processor | files | kB |\n|---|---|---|---|---|")
    for word in (*wanted(load(options.spec), ["all"]), "all"):
        runs = [export(options.spec, word) for _ in range(options.runs)]
        clock, cpu = (median(run[i] for run in runs) for i in (0, 1))
        _, _, files, size = runs[-1]
        print(f"| {word} | {clock:.1f} | {cpu:.1f} | {files} | {size / 1e3:.0f} |", flush=True)


if __name__ == "__main__":
    main()
