"""Compiles the kernels of this folder into a library beside them: on installation (see hook.py), or by hand.

    python fem/kernels/build.py

Where there is no C compiler fluxbore works without the library, by `fem.cell_arrays`, in three times the time. CC names
the compiler.
"""

from __future__ import annotations

import ctypes
import os
import platform
import sys
import zlib
from pathlib import Path

# What only a build needs is imported there: every process that computes asks for the library's name.

FOLDER = Path(__file__).parent
SOURCES = ("kernels.h", "cells.c", "condense.c", "band.c", "level.c", "build.py")
OPTIONS = ("-O3", "-std=c11", "-fPIC", "-fno-math-errno", "-ffp-contract=fast")
MACHINE = platform.machine().lower()
LEVELS: dict[str, tuple[str, ...]] = {"base": ("-DBYTES=16",)}
"""The options for each kind of processor; its vectors are so many bytes long. level.c tells which one this is."""

if MACHINE in ("x86_64", "amd64"):
    LEVELS["v3"] = ("-DBYTES=32", "-mavx2", "-mfma")


def library(folder: Path = FOLDER) -> Path:
    """The file for the sources as they are now, whether it exists or not: one of other sources is not taken for it."""
    code = 0
    for name in SOURCES:
        code = zlib.crc32((folder / name).read_bytes(), code)
    return folder / f"kernels-{MACHINE}-{code:08x}.so"


def compiler() -> list[str] | None:
    """The command of a C compiler, where there is one; raises ValueError for a CC that no shell would understand."""
    import shlex
    import shutil

    if os.environ.get("CC"):
        return shlex.split(os.environ["CC"])
    return next(([found] for name in ("cc", "gcc", "clang") if (found := shutil.which(name))), None)


def build(folder: Path = FOLDER) -> Path | None:
    """Compile what is not yet compiled; None where that cannot be, which is said. This machine's libraries of other
    sources are removed."""
    import shutil
    import subprocess
    import tempfile

    target = library(folder)
    if _loads(target):
        return target
    try:
        command = compiler()
        if command is None:
            _say("there is no C compiler, so the solver's kernels are not compiled: designs take longer")
            return None
        with tempfile.TemporaryDirectory() as place:
            made = _compiled(command, folder, Path(place))
            # Whole or not at all; what begins with a dot is nobody's data if this ends between the two.
            fresh = folder / f".kernels-{os.getpid()}.so"
            shutil.copy(made, fresh)
            fresh.replace(target)
        for old in folder.glob(f"kernels-{MACHINE}-*.so"):
            if old != target:
                old.unlink(missing_ok=True)
    except (OSError, ValueError, subprocess.CalledProcessError) as error:
        said = error.stderr if isinstance(error, subprocess.CalledProcessError) else ""
        _say(f"the solver's kernels could not be compiled, so designs take longer: {said or error}")
        return None
    return target


def _compiled(command: list[str], folder: Path, place: Path) -> Path:
    """A library in another folder, which loads here; raises OSError or CalledProcessError."""
    objects = [str(place / "level.o")]
    _run(*command, *OPTIONS, "-DLEVEL=base", *LEVELS["base"], "-c", str(folder / "level.c"), "-o", objects[0])
    for level, options in LEVELS.items():
        for name in ("cells", "condense", "band"):
            objects.append(str(place / f"{level}-{name}.o"))
            source = str(folder / f"{name}.c")
            _run(*command, *OPTIONS, f"-DLEVEL={level}", *options, "-c", source, "-o", objects[-1])
    made = place / "kernels.so"
    _run(*command, *OPTIONS, "-shared", "-o", str(made), *objects, "-lm")
    ctypes.CDLL(str(made))
    return made


def _loads(path: Path) -> bool:
    try:
        ctypes.CDLL(str(path))
    except OSError:
        return False
    return True


def _say(words: str) -> None:
    sys.stderr.write(f"fluxbore: {words}\n")


def _run(*command: str) -> None:
    import subprocess

    subprocess.run(command, check=True, capture_output=True, text=True)


if __name__ == "__main__":
    sys.exit(0 if build() else 1)
