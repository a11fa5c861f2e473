"""docs/constraints.md against the program: its figures exist, and its specification reads."""

import re
from pathlib import Path

from fluxbore.design.performance import FIGURES
from fluxbore.design.spec import loads
from fluxbore.design.spec_file import template

PAGE = (Path(__file__).parents[2] / "docs" / "constraints.md").read_text(encoding="utf-8")


def test_every_figure_of_the_page_exists() -> None:
    """Catches a figure that was renamed or is named only on paper."""
    rows = [line.split("|")[1] for line in PAGE.splitlines() if line.startswith("| `")]
    named = {name for row in rows for name in re.findall(r"`(\w+)`", row)}
    assert len(named) > 30
    assert named <= set(FIGURES)


def test_the_pages_keys_and_constraints_are_read() -> None:
    """Catches a key, a unit or a figure in the example that specifications refuse."""
    (block,) = re.findall(r"^```toml\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)
    keys, constraints = block.split("\n\n", 1)
    text = template("ipehla").replace("[operating_point]\n", "[operating_point]\n" + keys.split("\n", 1)[1] + "\n")
    given = [line.split("=")[0].strip() for line in keys.splitlines()[1:]]
    for name in given:
        # The template's own line of the same key gives way.
        lines = text.splitlines()
        at = [i for i, line in enumerate(lines) if line.split("=")[0].strip() == name]
        text = "\n".join(line for i, line in enumerate(lines) if i not in at[1:])
    before = len(loads(template("ipehla")).study.constraints)
    spec = loads(text + "\n" + constraints)
    assert spec.number("operating_point.duty") == 0.5
    assert spec.number("operating_point.peak_current") == 3.0
    added = {limit.subject for limit in spec.study.constraints[before:]}
    assert added == {"winding_temperature", "cylinder_safety", "fill_factor"}
