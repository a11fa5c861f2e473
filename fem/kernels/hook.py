"""Has the kernels compiled where a wheel or an editable installation is made."""

from __future__ import annotations

import runpy
import sys
import sysconfig
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class KernelHook(BuildHookInterface):  # type: ignore[type-arg]
    """hatchling's."""

    PLUGIN_NAME = "custom"

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Compile before the files are gathered. A wheel with a library is one platform's; without, anybody's.

        Elsewhere than on Linux only editable installations have one: Python's own name for the platform may promise
        more machines than a compiler has made it for.
        """
        if self.target_name != "wheel":
            return
        made: Path | None = runpy.run_path(str(Path(self.root, "fem", "kernels", "build.py")))["build"]()
        if made is None or sys.platform != "linux":
            return
        build_data["pure_python"] = False
        build_data["tag"] = f"py3-none-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"
        build_data["artifacts"].append(f"/fem/kernels/{made.name}")
