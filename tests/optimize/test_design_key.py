"""The key of a design: the same for what gives the same figures, another for anything that may change them."""

import importlib.metadata
import shutil
from dataclasses import dataclass, replace
from pathlib import Path

import pytest
import toy

import fluxbore
from fluxbore.optimize.design_key import ROOMS, canonical, design_key, program, source_hash


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


@pytest.mark.parametrize("every", [9, pytest.param(1, marks=pytest.mark.full)])
def test_one_character_of_any_module_changes_the_key(every, tmp_path, monkeypatch):
    """Catches a module whose change would leave old figures in the journal: new ones, nested ones, all of them."""
    package = Path(fluxbore.__path__[0])
    for room in ROOMS:
        shutil.copytree((package / room).resolve(), tmp_path / room, ignore=shutil.ignore_patterns("__pycache__"))
    monkeypatch.setattr(fluxbore, "__path__", [str(tmp_path)])
    modules = sorted(tmp_path.rglob("*.py"))[::every]
    assert {module.relative_to(tmp_path).parts[0] for module in modules} == {"design", "geometry", "fem", "optimize"}
    seen = {source_hash()}
    for module in modules:
        text = module.read_bytes()
        module.write_bytes(text[:-1] + bytes([text[-1] ^ 1]))
        seen.add(source_hash())
        module.write_bytes(text)
    assert len(seen) == len(modules) + 1


@pytest.mark.parametrize("library", ["numpy", "scipy"])
def test_another_version_of_what_calculates_changes_the_key(library, monkeypatch):
    """Catches figures of an old numpy or scipy that are taken for those of the new one."""
    version = importlib.metadata.version
    before = design_key(toy.spec(), "fem", toy.plain)
    monkeypatch.setattr(importlib.metadata, "version", lambda name: "0.1" if name == library else version(name))
    program.cache_clear()
    try:
        assert design_key(toy.spec(), "fem", toy.plain) != before
    finally:
        program.cache_clear()


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
