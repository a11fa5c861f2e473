"""Writes docs/reference.md from the program's own tables. Run it from the repository's top."""

from __future__ import annotations

from pathlib import Path

from fluxbore.design.materials import standard
from fluxbore.design.performance import FIGURES
from fluxbore.design.spec import KINDS
from fluxbore.design.study import DISTRIBUTIONS
from fluxbore.design.study_production_reader import PRODUCTION_KEYS
from fluxbore.design.study_search_reader import PARETO_KEYS, SEARCH_KEYS
from fluxbore.design.units import DIMENSIONS
from fluxbore.fem.femm_edit import BOUNDARY, CIRCUIT, KIND_OF_BOUNDARY, MATERIAL, POINT

TARGET = Path(__file__).with_suffix(".md")

ALGORITHMS = """
| algorithm | what it is | derivatives | limits on figures | when |
|---|---|---|---|---|
| `auto` | `SLSQP` where the model gives derivatives, else `COBYLA` | | | the default |
| `SLSQP` | sequential quadratic programming, local | yes | its own | few variables, limits that decide |
| `MMA` | moving asymptotes, local | yes | its own | many variables, many limits |
| `CCSAQ` | convex separable quadratics, local | yes | its own | as `MMA`, where that one stalls |
| `MLSL` | `SLSQP` from many places, global | yes | its own | several optima |
| `COBYLA` | linear models, local | no | its own | few variables, smooth figures |
| `BOBYQA` | quadratic models, local | no | by an augmented Lagrangian, dear | without limits on figures |
| `DIRECT-L` | division of the box, global | no | by a penalty | several optima, two or three variables |
| `CRS2` | random population, global | no | by a penalty | several optima, more variables |
| `ISRES` | evolution, global | no | its own | many limits; hundreds of designs |

All are NLopt's. Limits on variables are taken into their bounds; counts are enumerated.
"""

STUDY = """
| key | holds | meaning |
|---|---|---|
| `study.objective` | "maximise FIGURE" or "minimise FIGURE" | what the search is for |
| `study.hold` | dotted keys that have alternatives | what stays while variables move |
| `study.variables.N.key` | a dotted key | a quantity, a number, or a count of the actuator's parts |
| `study.variables.N.lower`, `.upper` | as the key | the bounds |
| `study.variables.N.resolution` | a step of the key | the workshop's; not for counts |
| `study.constraints.N.figure`, or `.key` | a figure or a dotted key | what is limited |
| `study.constraints.N.lower`, `.upper` | as the figure or key, "start" or "1.1 x start" | the limits |
| `study.sweeps.N.axes` | tables of `key` with `values`, or with `from`, `to`, `step` | a full grid |
| `study.pareto.against` | as the objective | the front's second goal |
| `study.production.tolerances.N.key` | a dotted key | a continuous quantity |
| `study.production.tolerances.N.tolerance` | a step of the key | to both sides of the nominal value |
| `study.production.tolerances.N.plus`, `.minus` | steps of the key, at least zero | where the two sides differ |
| `study.production.tolerances.N.distribution` | DISTRIBUTIONS | the limits of a normal one are at 3 sigma |
"""

SHARES = """
A limit on a share and the yield also take a percentage in quotes: `"55 %"` is 0.55. Shares are
SHARES.
The design's own plain numbers take no percentage. What `"0.8 x start"` means where the start is negative stands in
[Searching](optimisation.md).
"""

FEMM_UNITS = {
    "current": "A",
    "potential": "Wb/m",
    "mu_x": "1",
    "mu_y": "1",
    "coercivity": "A/m",
    "current_density": "MA/m^2",
    "conductivity": "MS/m",
    "fill": "1",
    "a0": "Wb/m",
    "a1": "Wb/m per unit of length",
    "a2": "Wb/m per unit of length",
    "phase": "degrees",
    "c0": "1/H",
    "c1": "A/m",
}
"""Of a bare number, by the last word of a key."""

FEMM_TEXT = """
For `--set KEY=VALUE` and `--sweep` of `fluxbore solve`. NAME is a name in the file, with its spaces and dots as they
are; one with an equals sign is put in quotes. A value is a bare number in the unit below, or a number with a unit of
its own where there is one (see Units; current densities in A/m^2, A/mm^2, MA/m^2, conductivities in S/m, MS/m).
Changes apply in their order.
"""

FEMM_GROUPS = """
| `group.N.magnetisation` | degrees, or a formula | of the labels of group N; x, y, r, z, theta and R in the formula |
| `group.N.turns` | 1 | of its labels that are in a circuit |
| `group.N.displacement.x`, `.y` | the file's unit | planar files; from where the file has it |
| `group.N.displacement.z` | the file's unit | axisymmetric files |
| `group.N.rotation` | degrees | planar files, counter-clockwise about the origin; magnetisation turns along |
| `depth` | the file's unit | planar files |
"""


def femm_keys() -> list[str]:
    """The section on `fluxbore solve --set`."""
    lines = [
        "",
        "## Keys of FEMM files",
        "",
        *FEMM_TEXT.strip().splitlines(),
        "",
        "| key | unit | of |",
        "|---|---|---|",
    ]
    for kind, properties, note in (
        ("circuit", CIRCUIT, "a circuit"),
        ("material", MATERIAL, "a material"),
        ("boundary", BOUNDARY, "a {} boundary"),
        ("point", POINT, "a point property"),
    ):
        for name in properties:
            owner = note.format(KIND_OF_BOUNDARY.get(name, "mixed"))
            lines.append(f"| `{kind}.NAME.{name}` | {FEMM_UNITS[name]} | {owner} |")
    return [*lines, *FEMM_GROUPS.strip().splitlines()]


def study_keys() -> list[str]:
    """The section on what a specification asks to be studied."""
    choices = " or ".join(f"`{name}`" for name in DISTRIBUTIONS)
    lines = ["", "## Keys of a study", "", *STUDY.strip().replace("DISTRIBUTIONS", choices).splitlines()]
    for key in (*SEARCH_KEYS, *PARETO_KEYS, *PRODUCTION_KEYS):
        holds = {"word": " or ".join(f"`{name}`" for name in key.choices), "integer": "a whole number"}
        default = "" if key.default is None else f"; default {key.show(key.default)}"
        what = key.dimension if key.kind == "quantity" else holds.get(key.kind, "a number")
        lines.append(f"| `{key.name}` | {what}{default} | {key.doc} |")
    shares = ", ".join(f"`{figure.name}`" for figure in FIGURES.values() if figure.dimension == "fraction")
    return [*lines, *SHARES.rstrip().replace("SHARES", shares).splitlines()]


def page() -> str:
    """The whole file."""
    lines = ["# Reference", "", "Written by `python docs/reference.py` from the program's own tables.", ""]
    lines += ["## Figures", "", "| name | unit in JSON and CSV | meaning |", "|---|---|---|"]
    lines += [f"| `{figure.name}` | {figure.si} | {figure.doc} |" for figure in FIGURES.values()]
    for kind in KINDS.values():
        lines += ["", f'## Keys of kind "{kind.name}"', ""]
        for group in kind.alternatives:
            names = ", ".join(f"`{key}`" for key in group.keys)
            lines.append(f"- {group.demand.capitalize()} of {names}: {group.rule}.")
        lines += ["", "| key | symbol | holds | default | meaning |", "|---|---|---|---|---|"]
        for key in kind.keys:
            holds = (
                f"{key.dimension}"
                if key.kind == "quantity"
                else {"word": "a word", "integer": "a whole number"}.get(key.kind, "a number")
            )
            default = "" if key.default is None else f"{key.show(key.default)}"
            lines.append(f"| `{key.name}` | {key.symbol} | {holds} | {default} | {key.doc} |")
    lines += study_keys()
    lines += femm_keys()
    lines += ["", "## Units", "", "| dimension | units |", "|---|---|"]
    lines += [f"| {item.name} | {', '.join(f'`{unit}`' for unit in item.units)} |" for item in DIMENSIONS.values()]
    lines += ["", "## Materials", "", "| name | kind | source |", "|---|---|---|"]
    lines += [f"| {item.name} | {type(item).__name__} | {item.source} |" for item in standard().values()]
    return "\n".join(lines) + "\n\n## Algorithms\n" + ALGORITHMS


if __name__ == "__main__":
    TARGET.write_text(page(), encoding="utf-8")
