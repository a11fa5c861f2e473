"""A specification's own materials survive being written out."""

from __future__ import annotations

from pathlib import Path

from fluxbore.design.spec import loads
from fluxbore.design.spec_file import template, to_toml

IRON = """
[materials."my iron"]
type = "soft iron"
density = "7.85 g/cm^3"
source = "a test"
bh_file = "iron.csv"
"""


def test_a_curve_from_a_file_travels_with_the_design(tmp_path: Path) -> None:
    """A design.toml in another folder that still points to a file beside the first specification."""
    (tmp_path / "iron.csv").write_text("0,0\n0.5,100\n1.0,300\n1.5,2000\n2.0,40000\n", encoding="utf-8")
    spec = loads(template("ipehla") + IRON, {"actuator.back_yoke.material": "my iron"}, base=tmp_path)
    again = loads(to_toml(spec), base=tmp_path / "elsewhere")
    assert again.materials["my iron"].curve == spec.materials["my iron"].curve
    assert again.fingerprint() == spec.fingerprint()


def test_another_curve_in_the_same_file_is_another_specification(tmp_path: Path) -> None:
    """Results of two irons taken for one because the file's name is the same."""
    prints = set()
    for last in (40000, 50000):
        (tmp_path / "iron.csv").write_text(f"0,0\n0.5,100\n1.0,300\n1.5,2000\n2.0,{last}\n", encoding="utf-8")
        prints.add(loads(template("ipehla") + IRON, base=tmp_path).fingerprint())
    assert len(prints) == 2
