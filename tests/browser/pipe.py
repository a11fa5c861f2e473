"""Chromium's remote control over two pipes: JSON messages of the DevTools protocol, each ended by a zero byte.

No port is opened, and nothing but the standard library is needed.
"""

from __future__ import annotations

import json
import os
import select
import time
from collections.abc import Callable
from typing import Any

Message = dict[str, Any]


class ProtocolError(Exception):
    """Chromium refused a command, ended, or did not answer in time."""


class Pipe:
    """Commands and events, one thread, in order. ``source`` and ``target`` are file descriptors that it owns."""

    def __init__(self, source: int, target: int) -> None:
        self._source, self._target = source, target
        self._buffer = b""
        self._number = 0
        self._listeners: dict[str, Callable[[Message], None]] = {}

    def listen(self, session: str, listener: Callable[[Message], None]) -> None:
        """Hand the events of a session to ``listener``."""
        self._listeners[session] = listener

    def forget(self, session: str) -> None:
        self._listeners.pop(session, None)

    def send(self, method: str, parameters: Message | None = None, session: str = "", limit: float = 60.0) -> Message:
        """The answer to a command; events that come before it reach their listeners. limit : s."""
        self._number += 1
        number, command = self._number, {"id": self._number, "method": method, "params": parameters or {}}
        if session:
            command["sessionId"] = session
        self._write(json.dumps(command).encode() + b"\0")
        end = time.monotonic() + limit
        while True:
            message = self._read(end, method)
            if message.get("id") == number:
                if "error" in message:
                    raise ProtocolError(f"{method}: {message['error'].get('message')}")
                found: Message = message["result"]
                return found
            self._dispatch(message)

    def pump(self, until: Callable[[], bool], what: str, limit: float = 60.0) -> None:
        """Take events until ``until`` holds. limit : s."""
        end = time.monotonic() + limit
        while not until():
            self._dispatch(self._read(end, what))

    def close(self) -> None:
        os.close(self._source)
        os.close(self._target)

    def _dispatch(self, message: Message) -> None:
        listener = self._listeners.get(message.get("sessionId", ""))
        if listener is not None and "method" in message:
            listener(message)

    def _write(self, data: bytes) -> None:
        while data:
            data = data[os.write(self._target, data) :]

    def _read(self, end: float, what: str) -> Message:
        while b"\0" not in self._buffer:
            ready, _, _ = select.select([self._source], [], [], max(end - time.monotonic(), 0))
            if not ready:
                raise ProtocolError(f"{what}: no answer in time")
            chunk = os.read(self._source, 1 << 20)
            if not chunk:
                raise ProtocolError(f"{what}: chromium has ended")
            self._buffer += chunk
        line, self._buffer = self._buffer.split(b"\0", 1)
        message: Message = json.loads(line)
        return message
