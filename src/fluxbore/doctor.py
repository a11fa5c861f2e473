"""What this machine has of what fluxbore needs, and how to get what is missing."""

import os
import sys
import tempfile
from dataclasses import dataclass
from importlib import metadata

from fluxbore.design.graphics import APT_LINE, has_egl, has_gl
from fluxbore.geometry import gl_stand_in

PYTHON_NEEDED = (3, 11)


@dataclass(frozen=True, slots=True)
class Finding:
    """One thing looked at: what was found, and the remedy if that will not do."""

    name: str
    ok: bool
    detail: str
    remedy: str | None = None


def diagnose() -> list[Finding]:
    """Look at the interpreter, packages, the solver's kernels, graphics libraries and the machine, in that order
    (0.2 s)."""
    return [_python(), *_packages(), _kernels(), _gl(), _egl(), _temporary_folder(), _cores()]


def report(findings: list[Finding]) -> str:
    """The findings as a table, each remedy under its line, and a verdict at the end."""
    width = max(len(finding.name) for finding in findings)
    lines = []
    for finding in findings:
        lines.append(f"{'ok     ' if finding.ok else 'MISSING'}  {finding.name:<{width}}  {finding.detail}")
        if finding.remedy:
            lines.append(f"{'':{9 + width}}  -> {finding.remedy}")
    missing = sum(not finding.ok for finding in findings)
    lines.append("Nothing is missing." if not missing else f"{missing} missing: see the arrow{'s'[: missing - 1]}.")
    return "\n".join(lines)


def _python() -> Finding:
    version = ".".join(map(str, sys.version_info[:3]))
    if sys.version_info[:2] >= PYTHON_NEEDED:
        return Finding("Python", True, f"{version}, {sys.executable}")
    needed = ".".join(map(str, PYTHON_NEEDED))
    return Finding("Python", False, version, f"install Python {needed} or newer, and run it with PYTHON=python{needed}")


def _packages() -> list[Finding]:
    """Versions as the installer wrote them down: importing cadquery and pyvista to ask would take seconds."""
    return [_package(name) for name in _requirements()]


def _requirements() -> list[str]:
    """The names of the packages that fluxbore asks for at run time, read from its own metadata."""
    try:
        lines = metadata.requires("fluxbore") or []
    except metadata.PackageNotFoundError:  # a bare source tree on PYTHONPATH
        return []
    bare = (line.split(";")[0] for line in lines if "extra ==" not in line)
    return sorted("".join(c if c.isalnum() or c in "-_." else " " for c in line).split()[0] for line in bare)


def _package(name: str) -> Finding:
    try:
        return Finding(name, True, metadata.version(name))
    except metadata.PackageNotFoundError:
        return Finding(name, False, "not installed", f"{sys.executable} -m pip install {name}")


def _kernels() -> Finding:
    """Without them nothing is missing but time."""
    from fluxbore.fem.native import level

    if level() is not None:
        return Finding("solver kernels", True, f"compiled; this processor is of level {level()}")
    detail = "not compiled: designs of the hybrid actuator take three times as long"
    remedy = f"install a C compiler (Debian: gcc libc6-dev), then: {sys.executable} -m fluxbore.fem.kernels.build"
    return Finding("solver kernels", True, detail, remedy)


def _gl() -> Finding:
    if has_gl():
        return Finding("libGL", True, "loads")
    if gl_stand_in.possible():
        return Finding("libGL", True, "does not load; CAD files are made without it")
    return Finding("libGL", False, "does not load: no CAD files", f"as root: {APT_LINE}")


def _egl() -> Finding:
    if has_egl():
        return Finding("EGL", True, "a driver gives a context: 3-D pictures can be drawn")
    detail = "no driver gives a context: the report shows a plane drawing for each 3-D picture"
    return Finding("EGL", False, detail, f"as root: {APT_LINE}")


def _temporary_folder() -> Finding:
    try:
        with tempfile.NamedTemporaryFile() as file:
            file.write(b"x")
            return Finding("temporary folder", True, f"{tempfile.gettempdir()} can be written")
    except OSError as error:
        return Finding("temporary folder", False, str(error), "set TMPDIR to a folder that can be written")


def _cores() -> Finding:
    usable = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    threads = os.environ.get("OPENBLAS_NUM_THREADS") or os.environ.get("OMP_NUM_THREADS") or f"unset, so {usable}"
    return Finding("cores", True, f"{usable}; BLAS threads a process: {threads}")
