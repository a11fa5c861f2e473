"""Stand-ins for libraries that are not there: that the system's loader takes them and that their functions return."""

import ctypes
import os
import platform
import subprocess
import sys
from pathlib import Path

import pytest

from fluxbore.geometry import gl_stand_in

pytestmark = pytest.mark.skipif(not gl_stand_in.possible(), reason="no stand-ins on this machine")

FUNCTIONS = [b"glClear", b"glXGetProcAddress", b"XOpenDisplay"]


@pytest.fixture
def library(tmp_path: Path) -> Path:
    path = tmp_path / "libabsent.so.1"
    path.write_bytes(gl_stand_in.shared_object(path.name, FUNCTIONS, *gl_stand_in._RETURN_ZERO[platform.machine()]))
    return path


def test_the_loader_finds_every_function_and_each_returns_nothing(library: Path) -> None:
    loaded = ctypes.CDLL(str(library))
    for name in FUNCTIONS:
        function = loaded[name.decode()]
        function.restype = ctypes.c_void_p
        assert function() is None
    with pytest.raises(AttributeError):
        loaded["glNone"]


@pytest.mark.parametrize("machine", sorted(gl_stand_in._RETURN_ZERO))
def test_a_library_says_what_it_is_for_each_machine(machine: str) -> None:
    """Read by binutils where they are; the header's own words otherwise."""
    number, code = gl_stand_in._RETURN_ZERO[machine]
    made = gl_stand_in.shared_object("libGL.so.1", FUNCTIONS, number, code)
    assert made[:6] == b"\x7fELF\x02\x01"
    assert int.from_bytes(made[18:20], "little") == number
    assert made.count(code) >= 1
    assert b"\0libGL.so.1\0" in made


def test_what_the_kernels_viewer_asks_for_is_read_from_its_files() -> None:
    asked = gl_stand_in._asked()
    assert {b"glClear", b"glXCreateContext", b"XOpenDisplay"} <= asked
    assert all(name.startswith((b"gl", b"X")) for name in asked)


@pytest.mark.full
def test_the_kernel_makes_a_solid_with_neither_library() -> None:
    """The stand-ins are loaded first here, so that the loader does not look for the libraries even where they are."""
    code = """
from fluxbore.geometry import gl_stand_in
gl_stand_in._loads = lambda name, loads=gl_stand_in._loads: name not in gl_stand_in.LIBRARIES and loads(name)
assert gl_stand_in.load()
from fluxbore.geometry.outline import rectangle
from fluxbore.geometry.part import Hole, Part
from fluxbore.geometry import kernel, solid
kernel.has_gl = lambda: True
part = Part("b", "block", "stator", "steel", (0.2, 0.4, 0.6), rectangle(0, 0.01, 0, 0.02), (Hole(0.01, 0.002),))
print(kernel.volume_of(solid.shape(part)))
maps = open("/proc/self/maps").read()
assert "memfd:libGL.so.1" in maps and "memfd:libX11.so.6" in maps
assert "/libGL.so" not in maps and "/libX11.so" not in maps
"""
    ran = subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
    )
    assert ran.returncode == 0, ran.stderr
    assert float(ran.stdout) == pytest.approx(6.25e-6, rel=1e-2)
