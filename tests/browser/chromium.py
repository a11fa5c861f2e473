"""A headless chromium without a network, for as long as a ``with`` lasts.

    with Chromium() as chromium, chromium.open(path) as page:
        assert page.evaluate("document.title") == "…"
        assert page.complaints == [] and page.requests == []

Debian's and Ubuntu's package is called chromium; CHROMIUM names another one.
"""

from __future__ import annotations

import fcntl
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from types import TracebackType

from browser.page import Page
from browser.pipe import Pipe, ProtocolError

NAMES = ("chromium", "chromium-browser", "google-chrome-stable", "google-chrome")

OPTIONS = (
    "--headless",
    "--remote-debugging-pipe",
    "--no-sandbox",  # which root may not use
    "--disable-gpu",
    "--use-angle=swiftshader",  # WebGL is drawn by the processor
    "--enable-unsafe-swiftshader",
    "--disable-dev-shm-usage",
    "--host-resolver-rules=MAP * ~NOTFOUND",
    "--proxy-server=127.0.0.1:9",  # what would get past the names finds nobody
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-default-apps",
    "--disable-sync",
    "--disable-extensions",
    "--no-first-run",
    "--no-default-browser-check",
    "--hide-scrollbars",
    "--mute-audio",
    "--force-color-profile=srgb",
    "--font-render-hinting=none",
)

# Gives the browser its two ends of the pipes as descriptors 3 and 4, which is where it looks for them.
LAUNCH = (
    "import os, sys; os.dup2(int(sys.argv[1]), 3); os.dup2(int(sys.argv[2]), 4); os.execv(sys.argv[3], sys.argv[3:])"
)


def find() -> str | None:
    """The program's path, if there is one."""
    wanted = os.environ.get("CHROMIUM")
    return next((path for name in ((wanted,) if wanted else NAMES) if (path := shutil.which(name))), None)


WHY_NOT = "no chromium on this machine: apt-get install chromium, or name one in CHROMIUM"


class Chromium:
    """The browser. Raises FileNotFoundError where there is none, ProtocolError where it does not start."""

    def __init__(self, options: Sequence[str] = ()) -> None:
        program = find()
        if program is None:
            raise FileNotFoundError(WHY_NOT)
        self._folder = tempfile.mkdtemp(prefix="fluxbore-browser-")
        (child_in, ours_out), (ours_in, child_out) = _high_pipe(), _high_pipe()
        command = [program, *OPTIONS, f"--user-data-dir={self._folder}", *options, "about:blank"]
        self.process = subprocess.Popen(
            [sys.executable, "-I", "-S", "-c", LAUNCH, str(child_in), str(child_out), *command],
            pass_fds=(child_in, child_out),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        os.close(child_in)
        os.close(child_out)
        self.pipe = Pipe(ours_in, ours_out)

    def open(
        self,
        target: Path | str,
        *,
        width: int = 1280,
        height: int = 800,
        dark: bool = False,
        calm: bool = False,
        touch: bool = False,
        scripts: bool = True,
        slower: float = 1.0,
    ) -> Page:
        """A page in a context of its own, loaded. target : a file, or an address.

        width, height : of the window in CSS pixels. dark : what the system prefers. calm : it prefers little motion.
        touch : a phone: no mouse, two device pixels to one of CSS. scripts : whether they run. slower : times that the
        page's processor is slowed down.
        """
        address = target if isinstance(target, str) and "://" in target else Path(target).resolve().as_uri()
        context = self.pipe.send("Target.createBrowserContext")["browserContextId"]
        found = self.pipe.send("Target.createTarget", {"url": "about:blank", "browserContextId": context})
        attached = self.pipe.send("Target.attachToTarget", {"targetId": found["targetId"], "flatten": True})
        page = Page(self.pipe, attached["sessionId"], context)
        page.resize(width, height, touch=touch)
        page.prefer(dark=dark, calm=calm)
        if not scripts:
            page.send("Emulation.setScriptExecutionDisabled", {"value": True})
        if slower != 1.0:
            page.throttle(slower)
        page.load(address)
        return page

    def close(self) -> None:
        try:
            self.pipe.send("Browser.close", limit=10.0)
            self.process.wait(10.0)
        except (ProtocolError, OSError, subprocess.TimeoutExpired):
            self.process.kill()
            self.process.wait()
        self.pipe.close()
        shutil.rmtree(self._folder, ignore_errors=True)

    def __enter__(self) -> Chromium:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()


def _high_pipe() -> tuple[int, int]:
    """Reading and writing end of a pipe, out of the way of the descriptors 3 and 4."""
    low = os.pipe()
    high = [fcntl.fcntl(end, fcntl.F_DUPFD_CLOEXEC, 10) for end in low]
    for end in low:
        os.close(end)
    return high[0], high[1]
