"""Whether this machine can load the solid modeller and draw three-dimensional pictures.

cadquery asks for libGL, if only to load, and can do without (`fluxbore.geometry.gl_stand_in`).  A picture drawn off
the screen needs EGL with a driver, and VTK does not raise without one: it kills the process.  So both are asked for
first, and the caller leaves the part out and says `APT_LINE`.
Standard library only: this file is also run by itself, before anything is installed, and prints the missing packages.
"""

import ctypes
import subprocess
import sys
from functools import cache

PACKAGES = ("libgl1", "libegl1", "libgl1-mesa-dri")
APT_LINE = f"apt-get install -y --no-install-recommends {' '.join(PACKAGES)}"

# Opens a display on each platform that VTK tries, the devices first, and makes an OpenGL context on it.
_EGL_PROBE = """
import ctypes, sys
egl = ctypes.CDLL("libEGL.so.1")
egl.eglGetProcAddress.restype = egl.eglGetDisplay.restype = egl.eglCreateContext.restype = ctypes.c_void_p
egl.eglGetDisplay.argtypes = [ctypes.c_void_p]
egl.eglInitialize.argtypes = [ctypes.c_void_p] * 3
egl.eglChooseConfig.argtypes = [ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_int, ctypes.c_void_p]
egl.eglCreateContext.argtypes = [ctypes.c_void_p] * 4
def function(name, result, *arguments):
    address = egl.eglGetProcAddress(name)
    return ctypes.CFUNCTYPE(result, *arguments)(address) if address else None
def draws(display):
    if not display or not egl.eglInitialize(display, None, None) or not egl.eglBindAPI(0x30A2):  # EGL_OPENGL_API
        return False
    wanted = (ctypes.c_int * 5)(0x3033, 0x0001, 0x3040, 0x0008, 0x3038)  # pbuffer surface, OpenGL renderable
    config, count = ctypes.c_void_p(), ctypes.c_int()
    if not egl.eglChooseConfig(display, wanted, ctypes.byref(config), 1, ctypes.byref(count)) or not count.value:
        return False
    return bool(egl.eglCreateContext(display, config, None, None))
displays = []
devices = (ctypes.c_void_p * 16)()
found = ctypes.c_int()
query = function(b"eglQueryDevicesEXT", ctypes.c_uint, ctypes.c_int, ctypes.c_void_p, ctypes.c_void_p)
of_platform = function(b"eglGetPlatformDisplayEXT", ctypes.c_void_p, ctypes.c_uint, ctypes.c_void_p, ctypes.c_void_p)
if query and of_platform and query(16, devices, ctypes.byref(found)):
    displays = [of_platform(0x313F, devices[i], None) for i in range(found.value)]  # EGL_PLATFORM_DEVICE_EXT
sys.exit(0 if any(draws(display) for display in [*displays, egl.eglGetDisplay(None)]) else 1)
"""


@cache
def has_gl() -> bool:
    """Whether libGL loads, for which cadquery asks.  Other systems than Linux bring their own."""
    return not sys.platform.startswith("linux") or _loads("libGL.so.1")


@cache
def has_egl() -> bool:
    """Whether a picture can be drawn off the screen: EGL loads and a driver gives it a context (0.1 s, once a process).

    Asked in a child process, because a broken driver ends the process that asks.
    """
    if not sys.platform.startswith("linux"):
        return True
    if not _loads("libEGL.so.1"):
        return False
    command = [sys.executable, "-I", "-S", "-c", _EGL_PROBE]
    try:
        probe = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, timeout=30, check=False)
    except (OSError, subprocess.TimeoutExpired):
        return False
    return probe.returncode == 0


def _loads(library: str) -> bool:
    try:
        ctypes.CDLL(library)
    except OSError:
        return False
    return True


if __name__ == "__main__":
    if not (has_gl() and has_egl()):
        print(*PACKAGES)  # noqa: T201  run as a script, by .ci/setup
