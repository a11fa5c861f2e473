"""One page in the browser: what it says, what it asks for, and what a user does to it."""

from __future__ import annotations

import base64
import time
from types import TracebackType
from typing import Any

from browser.pipe import Message, Pipe, ProtocolError

KEYS = {
    "Tab": (9, "\t"),
    "Enter": (13, "\r"),
    "Escape": (27, ""),
    " ": (32, " "),
    "PageUp": (33, ""),
    "PageDown": (34, ""),
    "End": (35, ""),
    "Home": (36, ""),
    "ArrowLeft": (37, ""),
    "ArrowUp": (38, ""),
    "ArrowRight": (39, ""),
    "ArrowDown": (40, ""),
    "Delete": (46, ""),
}
"""Code and text of keys that are no letter."""

MODIFIERS = {"Alt": 1, "Control": 2, "Meta": 4, "Shift": 8}

LOCAL = ("file:", "data:", "blob:", "about:")


class Page:
    """A loaded page.

    complaints : errors and warnings of the console, exceptions that nobody caught, violations of the policy, failed
    requests. messages : everything else that was written to the console. requests : addresses beyond this machine
    that were asked for.
    """

    def __init__(self, pipe: Pipe, session: str, context: str = "") -> None:
        self.complaints: list[str] = []
        self.messages: list[str] = []
        self.requests: list[str] = []
        self._pipe, self._session, self._context = pipe, session, context
        self._loaded = False
        pipe.listen(session, self._hear)
        for domain in ("Page", "Runtime", "Log", "Network", "Performance", "DOM"):
            self.send(f"{domain}.enable")
        none = {"latency": 0, "downloadThroughput": 0, "uploadThroughput": 0}
        self.send("Network.emulateNetworkConditions", {"offline": True, **none})

    # -- the protocol

    def send(self, method: str, parameters: Message | None = None, limit: float = 60.0) -> Message:
        """Any command of the DevTools protocol."""
        return self._pipe.send(method, parameters, self._session, limit)

    def _hear(self, message: Message) -> None:
        method, found = message["method"], message["params"]
        if method == "Page.loadEventFired":
            self._loaded = True
        elif method == "Runtime.consoleAPICalled":
            text = " ".join(str(item.get("value", item.get("description", ""))) for item in found["args"])
            (self.complaints if found["type"] in ("error", "warning", "assert") else self.messages).append(text)
        elif method == "Runtime.exceptionThrown":
            details = found["exceptionDetails"]
            self.complaints.append(details.get("exception", {}).get("description") or details["text"])
        elif method == "Log.entryAdded":
            text, level = found["entry"]["text"], found["entry"]["level"]
            slow = "GL Driver Message (OpenGL, Performance" in text  # of reading pixels back, which is what tests do
            (self.complaints if level in ("error", "warning") and not slow else self.messages).append(text)
        elif method == "Network.requestWillBeSent" and not found["request"]["url"].startswith(LOCAL):
            self.requests.append(found["request"]["url"])

    # -- the window

    def load(self, address: str, limit: float = 60.0) -> None:
        """Go to an address and wait for its load event."""
        self._loaded = False
        found = self.send("Page.navigate", {"url": address}, limit)
        if "errorText" in found:
            raise ProtocolError(f"{address}: {found['errorText']}")
        self._pipe.pump(lambda: self._loaded, f"loading {address}", limit)

    def resize(self, width: int, height: int, *, touch: bool = False) -> None:
        """CSS pixels; ``touch`` makes it a phone."""
        size = {"width": width, "height": height, "deviceScaleFactor": 2 if touch else 1, "mobile": touch}
        self.send("Emulation.setDeviceMetricsOverride", size)
        self.send("Emulation.setTouchEmulationEnabled", {"enabled": touch})

    def prefer(self, *, dark: bool = False, calm: bool = False, medium: str = "") -> None:
        """What the system prefers. medium : "print" shows the page as it would be printed, on the screen."""
        features = {
            "prefers-color-scheme": "dark" if dark else "light",
            "prefers-reduced-motion": "reduce" if calm else "no-preference",
        }
        listed = [{"name": name, "value": value} for name, value in features.items()]
        self.send("Emulation.setEmulatedMedia", {"media": medium, "features": listed})

    def throttle(self, times: float) -> None:
        """Slow the page's processor down by a factor."""
        self.send("Emulation.setCPUThrottlingRate", {"rate": times})

    # -- scripts

    def evaluate(self, script: str, limit: float = 60.0) -> Any:
        """The value of an expression; a promise is waited for. Raises ProtocolError where it throws."""
        asked = {"expression": script, "returnByValue": True, "awaitPromise": True, "userGesture": True}
        found = self.send("Runtime.evaluate", asked, limit)
        if "exceptionDetails" in found:
            details = found["exceptionDetails"]
            raise ProtocolError(details.get("exception", {}).get("description") or details["text"])
        return found["result"].get("value")

    def wait(self, condition: str, limit: float = 30.0) -> None:
        """Until an expression holds. limit : s, after which ProtocolError is raised."""
        end = time.monotonic() + limit
        while not self.evaluate(f"Boolean({condition})"):
            if time.monotonic() > end:
                raise ProtocolError(f"{condition}: not so after {limit:g} s")
            time.sleep(0.02)

    def settle(self) -> None:
        """Until two frames are drawn."""
        self.evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done(1))))")

    # -- a user's hands

    def box(self, selector: str) -> tuple[float, float, float, float]:
        """Left, top, width and height of the first element found, scrolled into view, in CSS pixels of the window."""
        found = self.evaluate(
            f"(() => {{ const e = document.querySelector({selector!r}); if (!e) return null;"
            " e.scrollIntoView({block: 'center', inline: 'center', behavior: 'instant'});"
            " const b = e.getBoundingClientRect(); return [b.x, b.y, b.width, b.height]; })()"
        )
        if found is None:
            raise ProtocolError(f"{selector}: no such element")
        left, top, width, height = found
        return left, top, width, height

    def middle(self, selector: str) -> tuple[float, float]:
        left, top, width, height = self.box(selector)
        return left + width / 2, top + height / 2

    def move(self, x: float, y: float, *, held: bool = False) -> None:
        """Move the mouse, with its left button held or not."""
        pressed = {"button": "left", "buttons": 1} if held else {"button": "none", "buttons": 0}
        self.send("Input.dispatchMouseEvent", {"type": "mouseMoved", "x": x, "y": y, **pressed})

    def click(self, where: str | tuple[float, float], *, count: int = 1) -> None:
        """Click the middle of an element, or a point of the window."""
        x, y = self.middle(where) if isinstance(where, str) else where
        self.move(x, y)
        for kind in ("mousePressed", "mouseReleased"):
            pressed = {"button": "left", "buttons": 1 if kind == "mousePressed" else 0, "clickCount": count}
            self.send("Input.dispatchMouseEvent", {"type": kind, "x": x, "y": y, **pressed})

    def drag(self, start: tuple[float, float], end: tuple[float, float], steps: int = 8) -> None:
        """Press, move in steps, release."""
        button = {"button": "left", "clickCount": 1}
        self.move(*start)
        self.send(
            "Input.dispatchMouseEvent", {"type": "mousePressed", "x": start[0], "y": start[1], "buttons": 1, **button}
        )
        for i in range(1, steps + 1):
            share = i / steps
            self.move(start[0] + share * (end[0] - start[0]), start[1] + share * (end[1] - start[1]), held=True)
        self.send(
            "Input.dispatchMouseEvent", {"type": "mouseReleased", "x": end[0], "y": end[1], "buttons": 0, **button}
        )

    def wheel(self, where: tuple[float, float], down: float) -> None:
        """Turn the wheel. down : CSS pixels."""
        turned = {"type": "mouseWheel", "x": where[0], "y": where[1], "deltaX": 0, "deltaY": down}
        self.send("Input.dispatchMouseEvent", turned)

    def touch(self, path: list[tuple[float, float]]) -> None:
        """Put a finger down at the first point, drag it along the rest, and lift it."""
        for i, (x, y) in enumerate(path):
            kind = "touchMove" if i else "touchStart"
            self.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [{"x": x, "y": y}]})
        self.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})

    def key(self, name: str, *modifiers: str, times: int = 1) -> None:
        """Press and release a key: a letter, or a name of KEYS. modifiers : of MODIFIERS."""
        code, text = KEYS[name] if name in KEYS else (ord(name.upper()), name)
        held = sum(MODIFIERS[word] for word in modifiers)
        common = {"key": name, "code": name if name in KEYS else "", "windowsVirtualKeyCode": code, "modifiers": held}
        for _ in range(times):
            down = {"type": "keyDown", "text": text} if text and not held & ~8 else {"type": "rawKeyDown"}
            self.send("Input.dispatchKeyEvent", {**down, **common})
            self.send("Input.dispatchKeyEvent", {"type": "keyUp", **common})

    def type(self, text: str) -> None:
        self.send("Input.insertText", {"text": text})

    # -- pictures

    def screenshot(self, *, whole: bool = False, clip: tuple[float, float, float, float] | None = None) -> bytes:
        """PNG of the window, of the whole page, or of a box (left, top, width, height) of the page."""
        asked: Message = {"format": "png", "captureBeyondViewport": whole or clip is not None}
        if whole:
            size = self.send("Page.getLayoutMetrics")["cssContentSize"]
            clip = (0, 0, size["width"], size["height"])
        if clip is not None:
            asked["clip"] = dict(zip(("x", "y", "width", "height"), clip, strict=True), scale=1)
        return base64.b64decode(self.send("Page.captureScreenshot", asked)["data"])

    def pdf(self) -> bytes:
        """Printed to A4, with backgrounds left out as printers do unless the page insists."""
        paper = {
            "paperWidth": 210 / 25.4,
            "paperHeight": 297 / 25.4,
            "printBackground": False,
            "preferCSSPageSize": True,
        }
        return base64.b64decode(self.send("Page.printToPDF", paper, limit=180.0)["data"])

    # -- the end

    def close(self) -> None:
        self._pipe.forget(self._session)
        self._pipe.send("Target.disposeBrowserContext", {"browserContextId": self._context})

    def __enter__(self) -> Page:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()
