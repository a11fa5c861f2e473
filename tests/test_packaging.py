"""What the archives hold: the rooms as fluxbore.design and so on, their data, and no link."""

import shutil
import stat
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path

import pytest

from fluxbore.fem.native import level

TOP = Path(__file__).resolve().parents[1]
ROOMS = ["design", "fem", "geometry", "optimize", "reports"]
LINK = stat.S_IFLNK >> 12


def _checkout(folder: Path) -> Path:
    """A copy of what the archives are built from, with links as links, and without what builds and runs left behind."""
    ignored = shutil.ignore_patterns("__pycache__", "*.egg-info")
    for name in [*ROOMS, "src"]:
        shutil.copytree(TOP / name, folder / name, symlinks=True, ignore=ignored)
    for name in ["pyproject.toml", "README.md", "LICENSE", ".gitignore"]:
        shutil.copy(TOP / name, folder / name)
    return folder


def _build(folder: Path, target: str) -> Path:
    """Build one archive offline with the locked back end, as pip would after fetching it."""
    command = [sys.executable, "-m", "hatchling", "build", "--target", target, "--directory", "dist"]
    subprocess.run(command, cwd=folder, capture_output=True, check=True)
    (archive,) = (folder / "dist").iterdir()
    return archive


def _contents(wheel: Path) -> dict[str, bytes]:
    with zipfile.ZipFile(wheel) as archive:
        assert not [item.filename for item in archive.infolist() if item.external_attr >> 28 == LINK]
        return {name: archive.read(name) for name in archive.namelist()}


def _expected(checkout: Path) -> dict[str, bytes]:
    """Every file of the rooms and of src/fluxbore under the name that an import gives it."""
    files = {}
    for room in ROOMS:
        for path in (checkout / room).rglob("*"):
            if path.is_file():
                files[f"fluxbore/{path.relative_to(checkout)}"] = path.read_bytes()
    for path in (checkout / "src" / "fluxbore").iterdir():
        if path.is_file():
            files[f"fluxbore/{path.name}"] = path.read_bytes()
    return files


@pytest.fixture(scope="module")
def checkout(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return _checkout(tmp_path_factory.mktemp("checkout"))


@pytest.fixture(scope="module")
def wheel(checkout: Path) -> Path:
    return _build(checkout, "wheel")


def test_the_wheel_holds_each_file_of_the_rooms_once_and_nothing_else(checkout: Path, wheel: Path) -> None:
    """Catches data left out (materials, templates, py.typed), a room archived twice, and stray files."""
    contents = {name: data for name, data in _contents(wheel).items() if ".dist-info/" not in name}
    assert any(name.startswith("fluxbore/fem/kernels/kernels-") for name in contents) == (level() is not None)
    assert contents == _expected(checkout)
    assert "fluxbore/py.typed" in contents


def test_the_wheel_imports_from_anywhere(wheel: Path, tmp_path: Path) -> None:
    """Catches a wheel that works only beside its checkout."""
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(tmp_path)
        metadata = next(name for name in archive.namelist() if name.endswith(".dist-info/entry_points.txt"))
        assert "fluxbore = fluxbore.cli:main" in archive.read(metadata).decode()
    code = f"import sys; sys.path.insert(0, {str(tmp_path)!r}); import fluxbore.design.graphics as g; print(g.__file__)"
    command = [sys.executable, "-I", "-S", "-c", code]
    printed = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True).stdout
    assert Path(printed.strip()) == tmp_path / "fluxbore" / "design" / "graphics.py"


def test_a_wheel_built_from_the_source_archive_is_the_same(checkout: Path, wheel: Path, tmp_path: Path) -> None:
    """Catches a source archive that lacks a room, or that holds the links, which do not survive every unpacking."""
    from_source = tmp_path / "checkout"
    shutil.copytree(checkout, from_source, symlinks=True, ignore=shutil.ignore_patterns("dist"))
    archive = _build(from_source, "sdist")
    with tarfile.open(archive) as source:
        assert not [member.name for member in source.getmembers() if member.issym() or member.islnk()]
        source.extraction_filter = getattr(
            tarfile, "data_filter", None
        )  # Debian 12's 3.11.2 has no filter argument yet
        source.extractall(tmp_path)
    rebuilt = _build(tmp_path / archive.name.removesuffix(".tar.gz"), "wheel")
    assert _code(rebuilt) == _code(wheel)


def test_a_checkout_with_links_as_text_files_gives_the_same_wheel(checkout: Path, wheel: Path, tmp_path: Path) -> None:
    """Catches a build through the links: with core.symlinks=false, git writes each as a file that holds its target."""
    plain = tmp_path / "checkout"
    shutil.copytree(checkout, plain, symlinks=True, ignore=shutil.ignore_patterns("dist"))
    for room in ROOMS:
        link = plain / "src" / "fluxbore" / room
        target = str(link.readlink())
        link.unlink()
        link.write_text(target)
    assert _code(_build(plain, "wheel")) == _code(wheel)


def _code(wheel: Path) -> dict[str, bytes]:
    """All but RECORD, which lists hashes of the rest."""
    return {name: data for name, data in _contents(wheel).items() if not name.endswith("/RECORD")}
