"""Writes docs/reference.md from the program's own tables. Run it from the repository's top."""

from __future__ import annotations

from pathlib import Path

from fluxbore.design.materials import standard
from fluxbore.design.performance import FIGURES
from fluxbore.design.spec import KINDS
from fluxbore.design.units import DIMENSIONS

TARGET = Path(__file__).with_suffix(".md")

ALGORITHMS = """
| algorithm | what it is | limits on figures | when |
|---|---|---|---|
| `COBYLA` | linear models, local | its own | the default: few variables, smooth figures |
| `BOBYQA` | quadratic models, local | by an augmented Lagrangian, which costs designs | without limits on figures |
| `DIRECT-L` | division of the box, global | by a penalty | several optima, two or three variables |
| `CRS2` | random population, global | by a penalty | several optima, more variables |
| `ISRES` | evolution, global | its own | many limits; hundreds of designs |

All are NLopt's. Limits on variables are taken into their bounds. A global algorithm gets the larger part of
`max_evaluations`, a local search from its best design the rest.
"""


def page() -> str:
    """The whole file."""
    lines = ["# Reference", "", "Written by `python docs/reference.py` from the program's own tables.", ""]
    lines += ["## Figures", "", "| name | unit in JSON and CSV | meaning |", "|---|---|---|"]
    lines += [f"| `{figure.name}` | {figure.si} | {figure.doc} |" for figure in FIGURES.values()]
    for kind in KINDS.values():
        lines += ["", f'## Keys of kind "{kind.name}"', ""]
        for group in kind.alternatives:
            names = ", ".join(f"`{key}`" for key in group.keys)
            lines.append(f"- Exactly {group.count} of {names}: {group.rule}.")
        lines += ["", "| key | symbol | holds | default | meaning |", "|---|---|---|---|---|"]
        for key in kind.keys:
            holds = (
                f"{key.dimension}"
                if key.kind == "quantity"
                else {"word": "a word", "integer": "a whole number"}.get(key.kind, "a number")
            )
            default = "" if key.default is None else f"{key.show(key.default)}"
            lines.append(f"| `{key.name}` | {key.symbol} | {holds} | {default} | {key.doc} |")
    lines += ["", "## Units", "", "| dimension | units |", "|---|---|"]
    lines += [f"| {item.name} | {', '.join(f'`{unit}`' for unit in item.units)} |" for item in DIMENSIONS.values()]
    lines += ["", "## Materials", "", "| name | kind | source |", "|---|---|---|"]
    lines += [f"| {item.name} | {type(item).__name__} | {item.source} |" for item in standard().values()]
    return "\n".join(lines) + "\n\n## Algorithms\n" + ALGORITHMS


if __name__ == "__main__":
    TARGET.write_text(page(), encoding="utf-8")
