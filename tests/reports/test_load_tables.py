"""Saturation and demagnetisation on the page: units, and what stands out."""

from __future__ import annotations

from fluxbore.fem.field_loads import Load
from fluxbore.reports.load_tables import section

LOADS = (
    Load("ring", 9, "iron", "1010", 1.334, 1.19, 2.031, 2.55, 0.489),
    Load("magnet", 8, "magnet", "N48", 9.55e5, 3.875e5, 8.288e5, 1.2537e6, 0.0038),
)


def test_numbers_and_units() -> None:
    """Catches a field strength in A/m beside a coercivity in kA/m, and iron beyond its knee called bad."""
    found = section(LOADS, "at no current")
    assert found is not None
    rings, magnets = found["table"].rows
    texts = [[cell.text.replace("\u00a0", " ") for cell in row] for row in (rings, magnets)]
    assert texts[0] == ["Rings (9)", "1010", "knee 1.334 T", "1.190 T", "2.031 T", "2.550 T", "48.9 %"]
    assert texts[1][:6] == [
        "Magnets (8)",
        "N48",
        "coercivity 955.0 kA/m",
        "387.5 kA/m",
        "828.8 kA/m",
        "1253.7 kA/m",
    ]
    assert (rings[6].tone, magnets[6].tone) == ("", "bad")
    assert "rings (9) 152 %; magnets (8) 87 %" in found["picture"].alt


def test_without_limits_there_is_no_section() -> None:
    """Catches an empty table."""
    assert section((), "at no current") is None
