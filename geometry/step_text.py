"""Text of STEP files (ISO 10303-21): words, numbers, the header, and instances put behind those that are there."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True)
class Header:
    """What the header says. name : the file's. program : with its version. approver : who releases the parts."""

    name: str
    description: str
    program: str
    time: str
    author: str = ""
    organisation: str = ""
    approver: str = ""


def word(text: str) -> str:
    """A string: quotes and backslashes doubled, letters beyond ASCII as the standard's codes."""
    doubled = text.replace("\\", "\\\\").replace("'", "''")
    return "'" + re.sub(r"[^ -~]+", lambda found: _coded(found[0]), doubled) + "'"


def _coded(text: str) -> str:
    if any(ord(letter) > 0xFFFF for letter in text):
        return f"\\X4\\{text.encode('utf-32-be').hex().upper()}\\X0\\"
    return f"\\X2\\{text.encode('utf-16-be').hex().upper()}\\X0\\"


def number(value: float) -> str:
    """A real, which has a point and a capital E."""
    digits, exponent, power = f"{value:.15G}".partition("E")
    return (digits if "." in digits else digits + ".") + exponent + power


def aggregate(items: Iterable[str]) -> str:
    return f"({','.join(items)})"


def with_header(text: str, header: Header) -> str:
    """The file with this header in place of its own, whose schema stays."""
    before, ends, data = text.partition("ENDSEC;")
    schema = re.search(r"FILE_SCHEMA\s*\(.*?\)\s*\)\s*;", before, re.DOTALL)
    preprocessor = re.search(r"'(Open CASCADE STEP processor [^']*)'", before)
    assert schema is not None
    name = (
        word(header.name),
        word(header.time),
        aggregate((word(header.author),)),
        aggregate((word(header.organisation),)),
        word(preprocessor[1] if preprocessor else ""),
        word(header.program),
        word(header.approver),
    )
    lines = (
        "ISO-10303-21;",
        "HEADER;",
        f"FILE_DESCRIPTION(({word(header.description)}),'2;1');",
        f"FILE_NAME({','.join(name)});",
        re.sub(r"\s*\n\s*", "", schema[0]),
        "",
    )
    return "\n".join(lines) + ends + data


@dataclass(slots=True)
class Instances:
    """Instances to be put behind a file's own. next : the number of the next one."""

    next: int
    lines: list[str] = field(default_factory=list)

    def add(self, content: str) -> str:
        """The reference to a new instance, "#12"."""
        reference = f"#{self.next}"
        self.lines.append(f"{reference} = {content};")
        self.next += 1
        return reference


def after(text: str) -> Instances:
    """None yet, numbered after the file's last one."""
    return Instances(1 + max((int(found) for found in re.findall(r"^#(\d+)\s*=", text, re.MULTILINE)), default=0))


def extended(text: str, instances: Instances) -> str:
    """The file with more instances at the end of its data."""
    data, ends, rest = text.rpartition("ENDSEC;")
    return "".join((data, *(f"{line}\n" for line in instances.lines), ends, rest))
