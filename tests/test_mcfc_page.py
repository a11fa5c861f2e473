"""The page on the contact-force benchmark: its script, and with -m full its commands, run as they stand."""

import re
import shlex
from pathlib import Path

import pytest
from mcfc_cases import example

from fluxbore.cli import main
from fluxbore.design.dynamics.contact_force import untuned_rmse

TOP = Path(__file__).parent.parent
PAGE = (TOP / "docs" / "mcfc.md").read_text(encoding="utf-8")


def blocks(language: str) -> list[str]:
    found = re.findall(r"^```(\w*)\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)
    return [block for name, block in found if name == language]


FIRST, SECOND = (line for block in blocks("") for line in block.splitlines() if line.startswith("fluxbore "))


def medians(capsys: pytest.CaptureFixture[str], command: str) -> dict[str, float]:
    """Of the three conditions (N), from the printed text."""
    assert main(shlex.split(command)[1:]) == 0
    printed = capsys.readouterr().out
    return {name: float(value) for name, value in re.findall(r"(P-[NPE]).*?(\d\.\d+) N", printed)}


@pytest.mark.full
def test_more_friction_than_the_controller_knows(monkeypatch, capsys):
    monkeypatch.chdir(TOP)
    assert medians(capsys, SECOND)["P-N"] == pytest.approx(1.1 * 3.2, abs=0.05)


@pytest.mark.full
def test_the_whole_benchmark(monkeypatch, capsys):
    monkeypatch.chdir(TOP)
    assert medians(capsys, FIRST) == pytest.approx({"P-N": 3.2, "P-P": 2.98, "P-E": 1.27}, abs=0.02)


def test_the_script(monkeypatch, capsys):
    monkeypatch.chdir(TOP)
    (script,) = blocks("python")
    exec(compile(script, "docs/mcfc.md", "exec"), {})
    assert capsys.readouterr().out.startswith("{'P-N': 3.2")


def test_the_number_without_a_plant():
    """The page's 3.20 N."""
    spec = example()
    errors = sorted(untuned_rmse(spec.actuator, spec.values).values())
    assert f"has a median of {(errors[17] + errors[18]) / 2:.2f} N" in " ".join(PAGE.split())
