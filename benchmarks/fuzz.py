"""Thousands of damaged FEMM files through the whole of `fluxbore solve`.

    python benchmarks/fuzz.py                          10,000 files, seed 1
    python benchmarks/fuzz.py --count 500 --seed 7     others
    python benchmarks/fuzz.py --only 1234              one of them, with its traceback
    python benchmarks/fuzz.py --write                  and docs/validation/fuzz.md

Each file is read, meshed, solved, refined and put into JSON, in a process that serves many files and in which every
warning is an error. A file gives an answer or one sentence; a traceback, more than 20 s or more than 2 GB (of that
process and the mesher's together) is an offence, and ends the run with status 3. The seconds are the processor's, so
that other programs on the machine do not count; what waits without reckoning is stopped by the clock. A run that was
interrupted goes on where it was: its log is named after commit and seed.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import select
import subprocess
import sys
import tempfile
import traceback
from collections import Counter
from pathlib import Path
from time import perf_counter
from typing import Any

TOP = Path(__file__).resolve().parents[1]
PAGE = TOP / "docs" / "validation" / "fuzz.md"
SECONDS, GIGABYTES = 20.0, 2.0
PATIENCE = 120.0
"""Seconds on the clock after which a process is stopped: it may share the processor with others."""
LIFE = 1000
"""Files that one process serves, so that a leak shows and does not add up."""
ADDRESS_SPACE = 6_000_000_000
"""Bytes: what wants more shall fail, and not the machine."""
Row = dict[str, Any]


def serve(seed: int, others: list[str]) -> None:
    """Numbers of files on the standard input, one outcome a line on the standard output."""
    import resource

    resource.setrlimit(resource.RLIMIT_AS, (ADDRESS_SPACE, ADDRESS_SPACE))
    sys.path.insert(0, str(TOP / "tests"))
    import femm_fuzz

    from fluxbore.fem.femm_reader import read_model

    models = tuple((Path(name).stem, read_model(name)) for name in others)
    femm_fuzz.models()
    for line in sys.stdin:
        number = int(line)
        row: Row = {"number": number}
        _forget_peak()
        start, reckoned = perf_counter(), _reckoned()
        try:
            item = femm_fuzz.mutant(seed, number, models)
            row["model"] = item.name
            found = femm_fuzz.outcome(item)
            row |= {"kind": found.kind, "sentence": found.sentence, "gist": femm_fuzz.gist(found)}
            row["unknowns"] = found.unknowns
        except Exception as error:
            row |= {"kind": "FAULT", "sentence": f"{type(error).__name__}: {error}"[:300]}
            row["gist"] = row["sentence"][:110]
            row["trace"] = traceback.format_exc()[-2500:]
        row["clock"] = round(perf_counter() - start, 3)
        row["seconds"] = round(_reckoned() - reckoned, 3)
        row["gigabytes"] = round(_peak() / 1e9, 3)
        print(json.dumps(row), flush=True)


def _processes() -> list[int]:
    from fluxbore.fem import mesh_worker

    return [os.getpid(), *(worker.pid for worker in mesh_worker._running)]


def _reckoned() -> float:
    """Seconds of the processor that this process and its mesher have had, those of meshers that were stopped too."""
    times = os.times()
    total = times.user + times.system + times.children_user + times.children_system
    for process in _processes()[1:]:
        with contextlib.suppress(OSError):
            fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
            total += (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
    return total


def _forget_peak() -> None:
    for process in _processes():
        with contextlib.suppress(OSError):
            Path(f"/proc/{process}/clear_refs").write_text("5")


def _peak() -> float:
    """Bytes, of this process and the mesher's since `_forget_peak`."""
    total = 0.0
    for process in _processes():
        with contextlib.suppress(OSError):
            for line in Path(f"/proc/{process}/status").read_text().splitlines():
                if line.startswith("VmHWM"):
                    total += 1024 * float(line.split()[1])
    return total


class Server:
    """A process that serves files one at a time."""

    def __init__(self, seed: int, others: list[str]) -> None:
        self.command = [sys.executable, "-W", "error", __file__, "--serve", "--seed", str(seed)]
        self.command += [word for name in others for word in ("--model", name)]
        self.process: subprocess.Popen[str] | None = None
        self.served = 0

    def ask(self, number: int) -> Row:
        if self.process is None or self.served >= LIFE:
            self.stop()
            self.served = 0
            threads = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")
            self.process = subprocess.Popen(
                self.command,
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                text=True,
                env={**os.environ, **threads},
            )
        self.served += 1
        process = self.process
        assert process.stdin is not None
        assert process.stdout is not None
        assert process.stderr is not None
        process.stdin.write(f"{number}\n")
        process.stdin.flush()
        waiting = PATIENCE + (60.0 if self.served == 1 else 0.0)  # the imports, and the models
        ready, _, _ = select.select([process.stdout], [], [], waiting)
        line = process.stdout.readline() if ready else ""
        if line:
            row: Row = json.loads(line)
            said, _, _ = select.select([process.stderr], [], [], 0)
            if said:
                words = os.read(process.stderr.fileno(), 4096).decode(errors="replace")
                row |= {"kind": "FAULT", "sentence": f"on stderr: {words}"[:300], "gist": "words on stderr"}
            return row
        process.kill()
        words = process.stderr.read()[-300:]
        self.stop()
        kind = "HANG" if not ready else "CRASH"
        return {
            "number": number,
            "kind": kind,
            "sentence": words,
            "gist": "",
            "seconds": PATIENCE,
            "clock": PATIENCE,
            "gigabytes": 0.0,
        }

    def stop(self) -> None:
        if self.process is None:
            return
        for pipe in (self.process.stdin, self.process.stdout, self.process.stderr):
            if pipe is not None:
                pipe.close()
        try:
            self.process.wait(5)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        self.process = None


def offends(row: Row) -> str:
    """Why an outcome is not accepted, or nothing."""
    if row["kind"] in ("FAULT", "HANG", "CRASH"):
        return str(row["kind"]).lower()
    if row["seconds"] > SECONDS:
        return f"{row['seconds']:.0f} s"
    return f"{row['gigabytes']:.1f} GB" if row["gigabytes"] > GIGABYTES else ""


def commit() -> str:
    command = ["git", "describe", "--always", "--dirty", "--abbrev=10"]
    return subprocess.run(command, cwd=TOP, capture_output=True, text=True, check=False).stdout.strip() or "unknown"


def run(numbers: range, seed: int, others: list[str], log: Path) -> list[Row]:
    """All outcomes; those in the log are not made again."""
    rows: dict[int, Row] = {}
    if log.exists():
        for line in log.read_text(encoding="utf-8").splitlines():
            with contextlib.suppress(ValueError):  # a last line that was cut short
                row = json.loads(line)
                rows[row["number"]] = row
    server, made = Server(seed, others), commit()
    with log.open("a", encoding="utf-8") as file:
        for number in numbers:
            if number in rows:
                continue
            row = server.ask(number) | {"commit": made}
            file.write(json.dumps(row) + "\n")
            file.flush()
            rows[number] = row
            if offends(row):
                print(f"{number} {row.get('model', '')}: {offends(row)}, {row['sentence']}", file=sys.stderr)
    server.stop()
    return [rows[number] for number in numbers]


def table(rows: list[Row]) -> str:
    """The outcomes by kind, and the sentences by how often they were said."""
    count = len(rows)
    offenders = [row for row in rows if offends(row)]
    kinds = Counter(
        row["sentence"] if row["kind"] == "answer" else "no convergence" if row["kind"] == "no convergence" else "error"
        for row in rows
        if not offends(row)
    )
    seconds = sorted(row["seconds"] for row in rows)
    sentences = Counter(row["gist"] for row in rows if row["kind"] != "answer" and not offends(row))
    heaviest = max(row["gigabytes"] for row in rows)
    lines = [
        "| outcome | files |",
        "|---|---|",
        f"| an answer as accurate as asked | {kinds['as accurate as asked']} |",
        f"| an answer, and a sentence that it is less accurate | {kinds['less accurate']} |",
        f"| a field, and a sentence that Newton's iteration did not converge | {kinds['no convergence']} |",
        f"| one sentence of what is wrong with the file | {kinds['error']} |",
        f"| a traceback, a warning, over {SECONDS:g} s, or over {GIGABYTES:g} GB | {len(offenders)} |",
        f"| together | {count} |",
        "",
        f"Seconds a file: median {seconds[count // 2]:.2f}, 99 % below {seconds[int(0.99 * count)]:.2f}, "
        f"longest {seconds[-1]:.1f}. Largest memory: {heaviest:.2f} GB.",
        "",
    ]
    if offenders:
        lines += ["| offender | model | why | what was said |", "|---|---|---|---|"]
        lines += [
            f"| {r['number']} | {r.get('model', '')} | {offends(r)} | {_cell(r['sentence'])} |" for r in offenders
        ]
        lines.append("")
    lines += [
        f"{len(sentences)} kinds of sentence, numbers and quotations left out:",
        "",
        "| said | times |",
        "|---|---|",
    ]
    lines += [f"| {_cell(gist)} | {times} |" for gist, times in sentences.most_common(60)]
    return "\n".join(lines)


def _cell(text: str) -> str:
    return " ".join(text.replace("|", "\\|").split())[:110]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=10_000)
    parser.add_argument("--first", type=int, default=0, help="number of the first file")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument(
        "--model", action="append", default=[], help="a .fem file to damage beside the gallery's models"
    )
    parser.add_argument("--log", type=Path, help="default: in the folder of temporary files")
    parser.add_argument("--only", type=int, help="one file: print it and its outcome")
    parser.add_argument("--write", action="store_true", help=f"write {PAGE.relative_to(TOP)}")
    parser.add_argument("--serve", action="store_true", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.serve:
        serve(options.seed, options.model)
        return 0
    if options.only is not None:
        return show(options.only, options.seed, options.model)
    log = options.log or Path(tempfile.gettempdir()) / f"fluxbore-fuzz-{commit()}-{options.seed}.jsonl"
    rows = run(range(options.first, options.first + options.count), options.seed, options.model, log)
    text = table(rows)
    print(text)
    if options.write:
        made = Counter(row["commit"] for row in rows)
        of = f"commit {next(iter(made))}"
        if len(made) > 1:
            of = "commits " + ", ".join(f"{name} ({count} files)" for name, count in made.items())
        files = "".join(f", {Path(name).name}" for name in options.model)
        head = (
            "# Damaged files\n\n"
            f"Written by `python benchmarks/fuzz.py --write`, seed {options.seed}, {of},\n"
            f"files {options.first} to {options.first + options.count - 1}. Models of the gallery{files} with one to\n"
            "three damages each: lines lost, doubled or exchanged, numbers out of range or slightly off, points\n"
            "merged, lines crossing, labels moved, rubbish. Each is read, meshed, solved, refined and written as\n"
            "JSON with every warning an error; seconds are the processor's.\n\n"
        )
        PAGE.write_text(head + text + "\n", encoding="utf-8")
    return 3 if any(offends(row) for row in rows) else 0


def show(number: int, seed: int, others: list[str]) -> int:
    sys.path.insert(0, str(TOP / "tests"))
    import femm_fuzz

    from fluxbore.fem.femm_reader import read_model

    models = tuple((Path(name).stem, read_model(name)) for name in others)
    item = femm_fuzz.mutant(seed, number, models)
    print(item.text)
    print(f"model {item.name}, groups {item.groups}, points {item.points}, accuracy {item.accuracy},", end=" ")
    print(f"open boundary {item.open_boundary}", flush=True)
    print(femm_fuzz.outcome(item))
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
