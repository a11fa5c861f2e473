"""Scripts and their data inside the page, and the policy that lets these scripts run and no other.

A script only adds to what is on the page: without it, pictures and tables stand as they are. Each is a plain source in
``assets``, allowed by the hash of its text, so that nothing that comes from a specification can ever run.
"""

from __future__ import annotations

import base64
import hashlib
import json
import re
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

_ASSETS = Path(__file__).parent / "assets"

_ENDS_EARLY = re.compile(r"</script|<!--|\r", re.IGNORECASE)
"""What would end a script before its end, begin a comment, or reach the browser as other bytes than were hashed."""


@dataclass(frozen=True, slots=True)
class Script:
    """A script's text as it stands between its tags."""

    name: str
    text: str

    @property
    def digest(self) -> str:
        """``sha256-…`` of the text in UTF-8, as a content policy names it."""
        found = hashlib.sha256(self.text.encode("utf-8")).digest()
        return f"sha256-{base64.b64encode(found).decode('ascii')}"


@dataclass(frozen=True, slots=True)
class Data:
    """What a script reads: an element of this identifier that holds JSON."""

    identifier: str
    value: Any

    @property
    def text(self) -> str:
        """The JSON with ``<`` escaped: no text in it can end the element."""
        found = json.dumps(self.value, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
        return found.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")


def load(*names: str) -> tuple[Script, ...]:
    """Scripts of ``assets`` by their paths there."""
    return tuple(script(name, (_ASSETS / name).read_text(encoding="utf-8")) for name in names)


def script(name: str, text: str) -> Script:
    """A script that a page can hold. Raises ValueError for a text that would not reach the browser whole."""
    if _ENDS_EARLY.search(text):
        raise ValueError(f"{name} holds </script, <!-- or a carriage return.")
    return Script(name, text)


def policy(scripts: Iterable[Script]) -> str:
    """The page may load nothing and run nothing but these scripts; its pictures are part of it."""
    hashes = " ".join(dict.fromkeys(f"'{item.digest}'" for item in scripts))
    allowed = f"script-src {hashes}; " if hashes else ""
    return f"default-src 'none'; {allowed}style-src 'unsafe-inline'; img-src data:; base-uri 'none'; form-action 'none'"
