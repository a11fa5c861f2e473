"""What the command line says of a comparison of designs."""

from __future__ import annotations

from typing import Any

from fluxbore.comparing import ComparisonResult
from fluxbore.optimize.evaluation import to_plain


def comparison_plain(result: ComparisonResult) -> dict[str, Any]:
    """Every design with its figures and its limits, and the files."""
    designs = [
        {
            "letter": letter,
            "source": source,
            "name": design.spec.word("actuator.name"),
            "kind": design.spec.kind.name,
            "status": design.status,
            "reasons": list(design.reasons),
            "warnings": list(design.evaluation.warnings),
            "performance": to_plain(design.evaluation)["performance"],
        }
        for letter, source, design in zip(result.letters, result.sources, result.designs, strict=True)
    ]
    return {"status": "ok" if result.ok else "not valid", "designs": designs, "files": [str(p) for p in result.files]}


def comparison_text(result: ComparisonResult) -> str:
    """What is wrong with designs, and the file."""
    return "\n".join([*result.reasons, *(str(path) for path in result.files)])
