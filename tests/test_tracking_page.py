"""The page on the tracking benchmark: its command's answer, its figures of closed form, and its keys."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest

from fluxbore.cli import main
from fluxbore.design.dynamics.tracking_benchmark import abilities
from fluxbore.design.dynamics.tracking_stand import tracking_stand
from fluxbore.design.spec import load
from fluxbore.optimize.hydrostatic_benchmark import TRACKING
from fluxbore.optimize.hydrostatic_common import weighed

TOP = Path(__file__).parent.parent
PAGE = (TOP / "docs" / "hydrostatic_tracking.md").read_text(encoding="utf-8")


def shown(name: str) -> float:
    """The number that the first table of figures has as simulated in this row."""
    row = next(line for line in PAGE.splitlines() if line.startswith(f"| {name} |"))
    (number, *_) = re.findall(r"[\d.]+", row.split("|")[2])
    return float(number)


def test_the_command_prints_what_the_page_quotes(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(TOP)
    command, answer = re.search(r"```\n(fluxbore identify.*?)\n```\n\n```text\n(.*?)\n```", PAGE, re.DOTALL).groups()  # type: ignore[union-attr]
    assert main(shlex.split(command)[1:]) == 0
    assert capsys.readouterr().out.rstrip("\n") == answer


def test_figures_of_closed_form_are_the_programs() -> None:
    spec = load(TOP / "examples" / "prehydra.toml")
    found = abilities(weighed(spec), tracking_stand(spec.values))
    assert f"{found['force_frequency_limit']:.1f}" == str(shown("force times frequency, (4)"))
    assert f"{found['maximum_velocity']:.4f}" == str(shown("largest speed"))
    assert f"{found['stroke_force']:.1f}" == str(shown("force over the stroke"))
    assert f"{found['minimum_friction']:.2f}" == str(shown("least friction"))
    assert round(found["friction_at_limit"], 2) == shown("friction at 0.45 m/s and 26 bar")
    assert round(found["force_at_rated_pressure"]) == shown("force at 70 bar, ideal")
    assert round(100 * found["efficiency"], 2) == shown("force efficiency, one cylinder")
    assert f"both cylinders: {100 * found['efficiency_both_cylinders']:.2f} %" in PAGE


def test_every_key_of_the_section_stands_on_the_page() -> None:
    """Pairs by their first and last."""
    kind = load(TOP / "examples" / "prehydra.toml").kind
    leaves = [key.leaf for key in kind.keys if key.name.startswith(TRACKING.section)]
    for leaf in leaves:
        if not re.fullmatch(r"(amplitude|frequency)_[1-6]", leaf):
            assert f"`{leaf}`" in PAGE or f"`{leaf} = " in PAGE, leaf
    assert {"amplitude_1", "frequency_6"} <= set(leaves)
