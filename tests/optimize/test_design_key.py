"""The key of a design: the same for what gives the same figures, another for anything that may change them."""

from dataclasses import dataclass, replace
from pathlib import Path

import pytest
import toy

import fluxbore
from fluxbore.optimize.design_key import canonical, design_key, source_hash


@dataclass(frozen=True)
class Iron:
    curve: object


def test_the_key_follows_what_decides_the_figures():
    """Catches a figure taken from the journal for another design, route, model or material."""
    spec = toy.spec(x=1.0)
    own = {"iron": {"curve": "table.csv"}}
    keys = [
        design_key(spec, "fem", toy.plain),
        design_key(toy.spec(x=1.0 + 2**-52), "fem", toy.plain),
        design_key(toy.spec(n=2), "fem", toy.plain),
        design_key(spec, "network", toy.plain),
        design_key(spec, "fem", toy.slow),
        design_key(replace(spec, materials={"iron": Iron((1.0, 2.0))}, own_materials=own), "fem", toy.plain),
        design_key(replace(spec, materials={"iron": Iron((1.0, 2.5))}, own_materials=own), "fem", toy.plain),
    ]
    assert len(set(keys)) == len(keys)
    assert design_key(toy.spec(x=1.0, sweeps=(toy.square(),)), "fem", toy.plain) == keys[0]


def test_long_arrays_are_told_apart_in_their_middle():
    """Catches a key made of numpy's repr, which leaves out the middle of a B-H table."""
    np = pytest.importorskip("numpy")
    one, other = np.zeros(5000), np.zeros(5000)
    other[2500] = 1e-12
    assert canonical(Iron(one)) == canonical(Iron(np.zeros(5000)))
    assert canonical(Iron(one)) != canonical(Iron(other))


def test_the_source_hash_follows_links_and_sees_data_but_not_reports(tmp_path, monkeypatch):
    """Catches an editable install whose linked rooms are passed over: then nothing would ever be computed anew."""
    rooms = tmp_path / "rooms"
    for room in ("design", "fem", "geometry", "optimize", "reports"):
        (rooms / room / "data").mkdir(parents=True)
        (rooms / room / "model.py").write_text("x = 1\n")
    package = tmp_path / "package"
    package.mkdir()
    for room in rooms.iterdir():
        (package / room.name).symlink_to(room)
    monkeypatch.setattr(fluxbore, "__path__", [str(package)])
    seen = [source_hash()]

    def changed(path: str, text: str) -> bool:
        file = Path(rooms / path)
        file.parent.mkdir(exist_ok=True)
        file.write_text(text)
        seen.append(source_hash())
        return seen[-1] != seen[-2]

    assert changed("fem/model.py", "x = 2\n")
    assert changed("design/data/iron.csv", "0 0\n")
    assert changed("optimize/new.py", "")
    assert not changed("reports/model.py", "x = 3\n")
    assert not changed("fem/__pycache__/model.pyc", "compiled")
    assert len(set(seen)) == 4
