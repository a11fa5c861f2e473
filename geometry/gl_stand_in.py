"""The CAD kernel on a machine without graphics libraries: empty stand-ins for libGL and libX11.

The kernel's wheel is one module, so that its viewer, which nothing here uses, makes the loader ask for both libraries
before a single solid can be made. Where they are missing, two shared objects of a few kilobytes take their names: they
define what the viewer asks for, each function returning 0, and are loaded from memory before the kernel is. Libraries
that do load are left alone. Linux on x86-64 and 64-bit ARM.
"""

from __future__ import annotations

import ctypes
import os
import platform
import struct
import sys
from functools import cache
from importlib.util import find_spec
from pathlib import Path

LIBRARIES = {"libGL.so.1": b"gl", "libX11.so.6": b"X"}
"""Name of a library -> how the names of its functions begin."""

_ASKING = "cadquery_ocp*.libs/libTK*.so*"
"""Below the folder of packages: the kernel's libraries."""

_RETURN_ZERO = {"x86_64": (62, bytes.fromhex("31c0c3")), "aarch64": (183, bytes.fromhex("000080d2c0035fd6"))}
"""Machine -> its number in ELF and the code of a function that returns 0."""

_PAGE = 0x10000
"""Bytes; the largest page of any of these machines."""

_HEADER, _SEGMENT, _SYMBOL, _ENTRY = 64, 56, 24, 16
"""Bytes of ELF's header, of a program header, of a symbol, of an entry of the dynamic section."""

_kept: list[int] = []
"""The files in memory, open for good: the loader tells libraries apart by their paths, which hold these numbers."""


def load() -> bool:
    """Let stand-ins take the place of libraries that do not load; whether the viewer now finds all it asks for.

    Once a process, before the kernel is imported.
    """
    machine = _RETURN_ZERO.get(platform.machine())
    if machine is None or not sys.platform.startswith("linux") or not hasattr(os, "memfd_create"):
        return False
    asked = _asked()
    return bool(asked) and all(_loads(name) or _load(name, asked, *machine) for name in LIBRARIES)


@cache
def possible() -> bool:
    """Whether `load` would do, as far as can be told without loading anything."""
    known = platform.machine() in _RETURN_ZERO and sys.platform.startswith("linux") and hasattr(os, "memfd_create")
    return known and bool(_asked())


def shared_object(name: str, functions: list[bytes], number: int, code: bytes) -> bytes:
    """An ELF file of a library with this name, whose functions are all the same piece of code.

    One segment has headers, code, hash table and symbols; the other, which the loader may write, the dynamic section.
    """
    texts, places = b"\0" + name.encode() + b"\0", []
    for function in functions:
        places.append(len(texts))
        texts += function + b"\0"
    count = len(functions) + 1
    start = _HEADER + 4 * _SEGMENT
    hashed = _aligned(start + len(code))
    symbols = _aligned(hashed + 4 * (3 + count))
    strings = symbols + _SYMBOL * count
    dynamic = _aligned(strings + len(texts))
    tags = ((14, 1), (4, hashed), (5, strings), (6, symbols), (10, len(texts)), (11, _SYMBOL), (0, 0))
    size = _ENTRY * len(tags)
    where = dynamic, dynamic + _PAGE, dynamic + _PAGE, size, size
    segments = (
        (1, 5, 0, 0, 0, dynamic, dynamic, _PAGE),
        (1, 6, *where, _PAGE),
        (2, 6, *where, 8),
        (0x6474E551, 6, 0, 0, 0, 0, 0, 16),  # a stack that is no code
    )
    # One bucket: the chain goes through all symbols, of which there are few.
    chain = [*range(2, count), 0] if functions else []
    pieces = {
        0: struct.pack("<4s5B7x2HI3QI6H", b"\x7fELF", 2, 1, 1, 0, 0, 3, number, 1, 0, 64, 0, 0, 64, 56, 4, 64, 0, 0),
        _HEADER: b"".join(struct.pack("<2I6Q", *segment) for segment in segments),
        start: code,
        hashed: struct.pack(f"<{3 + count}I", 1, count, min(1, len(functions)), 0, *chain),
        symbols + _SYMBOL: b"".join(struct.pack("<I2BH2Q", text, 0x12, 0, 1, start, len(code)) for text in places),
        strings: texts,
        dynamic: b"".join(struct.pack("<2Q", *tag) for tag in tags),
    }
    file = bytearray(dynamic + size)
    for place, piece in pieces.items():
        file[place : place + len(piece)] = piece
    return bytes(file)


def undefined(library: bytes) -> set[bytes]:
    """The names that a 64-bit little-endian ELF file wants from others."""
    sections_at, entry, count = struct.unpack_from("<Q", library, 40)[0], *struct.unpack_from("<2H", library, 58)
    sections = [struct.unpack_from("<2I4Q2I2Q", library, sections_at + i * entry) for i in range(count)]
    dynamic = next(section for section in sections if section[1] == 11)
    texts = sections[dynamic[6]][4]
    found = set()
    for place in range(dynamic[4], dynamic[4] + dynamic[5], _SYMBOL):
        name, _, _, section = struct.unpack_from("<I2BH", library, place)
        if name and section == 0:
            found.add(library[texts + name : library.index(b"\0", texts + name)])
    return found


@cache
def _asked() -> frozenset[bytes]:
    """What the kernel's viewer wants from both libraries."""
    spec = find_spec("OCP")
    if spec is None or spec.origin is None:
        return frozenset()
    files = [
        path
        for path in Path(spec.origin).parent.parent.glob(_ASKING)
        if path.name.startswith(("libTKOpenGl", "libTKService"))
    ]
    names = set[bytes]().union(*(undefined(path.read_bytes()) for path in files))
    return frozenset(name for name in names if name.startswith(tuple(LIBRARIES.values())))


def _loads(name: str) -> bool:
    try:
        ctypes.CDLL(name)
    except OSError:
        return False
    return True


def _load(name: str, asked: frozenset[bytes], number: int, code: bytes) -> bool:
    functions = sorted(function for function in asked if function.startswith(LIBRARIES[name]))
    file = os.memfd_create(name)
    _kept.append(file)
    os.write(file, shared_object(name, functions, number, code))
    return _loads(f"/proc/self/fd/{file}")


def _aligned(place: int) -> int:
    return -(-place // 16) * 16
