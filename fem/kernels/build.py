"""Compiles the kernels of this folder into a library beside them: on installation (see hook.py), or by hand.

    python fem/kernels/build.py

Where there is no C compiler fluxbore works without the library, by `fem.cell_arrays`; designs then take three times as long.
CC names the compiler.
"""

from __future__ import annotations

import os
import platform
import shlex
import shutil
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

FOLDER = Path(__file__).parent
SOURCES = ("kernels.h", "cells.c", "condense.c", "band.c", "level.c")
OPTIONS = ("-O3", "-std=c11", "-fPIC", "-fno-math-errno", "-ffp-contract=fast")
LEVELS: dict[str, tuple[str, ...]] = {"base": ("-DBYTES=16",)}
"""The options for each kind of processor; its vectors are so many bytes long."""

if platform.machine().lower() in ("x86_64", "amd64"):
    LEVELS["v3"] = ("-DBYTES=32", "-march=x86-64-v3")


def library(folder: Path = FOLDER) -> Path:
    """The file for the sources as they are now, whether it exists or not: one of other sources is not taken for it."""
    code = 0
    for name in SOURCES:
        code = zlib.crc32((folder / name).read_bytes(), code)
    return folder / f"kernels-{code:08x}.so"


def compiler() -> list[str] | None:
    """The command of a C compiler, where there is one."""
    if os.environ.get("CC"):
        return shlex.split(os.environ["CC"])
    return next(([found] for name in ("cc", "gcc", "clang") if (found := shutil.which(name))), None)


def build(folder: Path = FOLDER) -> Path | None:
    """Compile; None where there is no compiler or it fails, which is said. Libraries of other sources are removed."""
    target, command = library(folder), compiler()
    if target.exists():
        return target
    if command is None:
        _say("no C compiler, so the solver's kernels are not compiled: designs take longer")
        return None
    with tempfile.TemporaryDirectory(dir=folder) as place:
        try:
            objects = []
            for level, options in LEVELS.items():
                for name in ("cells.c", "condense.c", "band.c"):
                    objects.append(f"{place}/{level}-{name}.o")
                    _run(*command, *OPTIONS, *options, f"-DLEVEL={level}", "-c", str(folder / name), "-o", objects[-1])
            made = f"{place}/kernels.so"
            _run(*command, *OPTIONS, "-shared", "-o", made, *objects, str(folder / "level.c"), "-lm")
        except (OSError, subprocess.CalledProcessError) as error:
            said = error.stderr if isinstance(error, subprocess.CalledProcessError) else str(error)
            _say(f"the solver's kernels could not be compiled: designs take longer\n{said}")
            return None
        Path(made).replace(target)  # whole or not at all
    for old in folder.glob("kernels-*.so"):
        if old != target:
            old.unlink(missing_ok=True)
    return target


def _say(words: str) -> None:
    sys.stderr.write(f"fluxbore: {words}\n")


def _run(*command: str) -> None:
    subprocess.run(command, check=True, capture_output=True, text=True)


if __name__ == "__main__":
    sys.exit(0 if build() else 1)
