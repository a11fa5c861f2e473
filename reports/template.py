"""Fills a template of ``templates``: style sheet, scripts and their policy, and the filters that all pages use."""

from __future__ import annotations

import re
from collections.abc import Sequence
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fluxbore.reports.scripts import Data, Script, policy

if TYPE_CHECKING:
    from markupsafe import Markup

_HERE = Path(__file__).parent


def fill(name: str, scripts: Sequence[Script] = (), data: Sequence[Data] = (), **shown: Any) -> str:
    """The page as text. scripts : in the order in which they run; data : what they read. shown : for the template."""
    from jinja2 import Environment, FileSystemLoader, StrictUndefined
    from markupsafe import Markup

    environment = Environment(
        loader=FileSystemLoader(_HERE / "templates"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        # "{#" opens a rule for an identifier in CSS.
        comment_start_string="{##",
        comment_end_string="##}",
    )
    environment.filters["symbol"] = _symbol
    environment.filters["svg"] = lambda item: Markup(item.markup)
    environment.filters["json"] = lambda value: Markup(Data("", value).text)
    css = (_HERE / "assets" / "report.css").read_text(encoding="utf-8")
    return environment.get_template(name).render(
        policy=policy(scripts),
        css=Markup(css),
        scripts=[Markup(item.text) for item in scripts],
        script_data=[{"id": item.identifier, "text": Markup(item.text)} for item in data],
        **shown,
    )


def _symbol(text: str) -> Markup:
    """``τ_f`` with a real subscript."""
    from markupsafe import Markup

    return Markup(re.sub(r"_(\w+)", r"<sub>\1</sub>", escape(text)))
