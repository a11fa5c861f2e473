"""What the command line says of a whole run."""

from __future__ import annotations

from typing import Any

from fluxbore.design.spec import Spec
from fluxbore.design_result import DesignResult
from fluxbore.messages import evaluation_text
from fluxbore.optimize.evaluation import to_plain
from fluxbore.pareto_messages import pareto_plain, pareto_text
from fluxbore.search_messages import robust_design_text, search_plain, search_text
from fluxbore.tolerance_messages import robust_plain, robust_text, tolerance_plain, tolerance_text


def design_plain(result: DesignResult) -> dict[str, Any]:
    """The whole run."""
    reasons = list(result.reasons)
    if result.search is not None and result.search.chosen is None:
        reasons = search_plain(result.search)["reasons"]
    return {
        "status": result.status,
        "reasons": reasons,
        "performance": to_plain(result.evaluation)["performance"],
        "search": search_plain(result.search) if result.search is not None else None,
        "front": pareto_plain(result.front) if result.front is not None else None,
        "robust": robust_plain(result.robust) if result.robust is not None else None,
        "tolerance": tolerance_plain(result.tolerance) if result.tolerance is not None else None,
        "files": [str(path) for path in result.files],
        "warnings": [*result.evaluation.warnings, *result.warnings],
    }


def design_text(spec: Spec, result: DesignResult) -> str:
    """The search's result, or the design's figures, what else was asked for, what is wrong, where the files are."""
    search = result.search
    parts = [search_text(spec, search) if search is not None else evaluation_text(spec, result.evaluation)]
    if result.front is not None:
        parts.append(pareto_text(spec, result.front))
    if result.robust is not None:
        parts += filter(None, [robust_text(spec, result.robust), robust_design_text(spec, result.robust)])
    elif result.tolerance is not None:
        parts.append(tolerance_text(spec, result.tolerance))
    told = search is not None and search.chosen is None
    bad = [] if result.ok or told else [f"{result.status}: {' '.join(result.reasons)}"]
    top = [str(path) for path in result.files if path.parent.name != "parts"]
    return "\n".join(["\n\n".join(parts), *bad, "", *top])
