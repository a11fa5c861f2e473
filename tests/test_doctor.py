"""The doctor: what it says of a machine that lacks something, and that asking costs little."""

import subprocess
import sys
from importlib import metadata
from pathlib import Path

import pytest

from fluxbore import doctor
from fluxbore.design import graphics
from fluxbore.doctor import Finding, diagnose, report


def test_every_run_time_dependency_is_looked_at() -> None:
    """Catches a dependency that pyproject.toml gains and the doctor does not know of."""
    findings = {finding.name: finding for finding in diagnose()}
    for name in ("numpy", "scipy", "nlopt", "jinja2", "matplotlib", "cadquery", "pyvista"):
        assert findings[name].detail == metadata.version(name)
    assert findings["Python"].ok


def test_missing_graphics_are_answered_with_the_one_line_that_mends_them(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(doctor, "has_gl", lambda: False)
    monkeypatch.setattr(doctor, "has_egl", lambda: False)
    monkeypatch.setattr(doctor.gl_stand_in, "possible", lambda: False)
    findings = {finding.name: finding for finding in diagnose()}
    assert not findings["libGL"].ok
    assert not findings["EGL"].ok
    text = report(list(findings.values()))
    assert text.count("apt-get install -y --no-install-recommends libgl1 libegl1 libgl1-mesa-dri") == 2
    assert text.endswith("2 missing: see the arrows.")


def test_without_libgl_alone_nothing_is_missing_where_it_can_be_stood_in_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(doctor, "has_gl", lambda: False)
    monkeypatch.setattr(doctor.gl_stand_in, "possible", lambda: True)
    finding = next(finding for finding in diagnose() if finding.name == "libGL")
    assert finding.ok
    assert "without it" in finding.detail


def test_a_missing_package_is_answered_with_its_install_line(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(doctor, "_requirements", lambda: ["no-such-package-as-this"])
    finding = next(finding for finding in diagnose() if finding.name == "no-such-package-as-this")
    assert not finding.ok
    assert finding.remedy == f"{sys.executable} -m pip install no-such-package-as-this"


def test_a_temporary_folder_that_cannot_be_written_is_named(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(doctor.tempfile, "tempdir", str(tmp_path / "absent"))
    finding = next(finding for finding in diagnose() if finding.name == "temporary folder")
    assert not finding.ok
    assert "TMPDIR" in str(finding.remedy)


def test_a_sound_machine_gets_one_line_each_and_no_arrow() -> None:
    text = report([Finding("Python", True, "3.11.2"), Finding("cores", True, "2")])
    assert text.splitlines() == ["ok       Python  3.11.2", "ok       cores   2", "Nothing is missing."]


@pytest.mark.parametrize("probe", ["has_gl", "has_egl"])
def test_a_library_that_does_not_load_is_a_no_and_not_an_exception(probe: str, monkeypatch: pytest.MonkeyPatch) -> None:
    def absent(name: str) -> None:
        raise OSError(f"{name}: cannot open shared object file")

    monkeypatch.setattr(graphics.ctypes, "CDLL", absent)
    monkeypatch.setattr(graphics.sys, "platform", "linux")
    uncached = getattr(graphics, probe).__wrapped__
    assert uncached() is False


def test_a_driver_that_kills_its_process_is_a_no(monkeypatch: pytest.MonkeyPatch) -> None:
    """Catches a probe moved into this process: VTK's own answer to a missing driver is a segmentation fault."""
    monkeypatch.setattr(graphics, "_loads", lambda _: True)
    monkeypatch.setattr(graphics, "_EGL_PROBE", "import os, signal; os.kill(os.getpid(), signal.SIGSEGV)")
    assert graphics.has_egl.__wrapped__() is False


def test_the_probes_run_before_anything_is_installed() -> None:
    """Catches an import of fluxbore or a library in graphics.py: set-up runs it by itself, with a bare interpreter."""
    script = [sys.executable, "-I", "-S", graphics.__file__]
    printed = subprocess.run(script, capture_output=True, text=True, check=True).stdout
    assert printed.split() in ([], list(graphics.PACKAGES))


def test_the_doctor_loads_nothing_heavy() -> None:
    code = (
        "import sys; from fluxbore.doctor import diagnose; diagnose();"
        "print(*{name.split('.')[0] for name in sys.modules} & {'numpy', 'scipy', 'cadquery', 'pyvista', 'matplotlib'})"
    )
    printed = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    assert printed.strip() == ""


def test_kernels_that_are_not_compiled_cost_time_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """Catches a slow machine whose user never learns why, and a verdict that something is missing."""
    monkeypatch.setattr("fluxbore.fem.native.level", lambda: None)
    finding = next(finding for finding in diagnose() if finding.name == "solver kernels")
    assert finding.ok
    assert "three times as long" in finding.detail
    assert str(finding.remedy).endswith("-m fluxbore.fem.kernels.build")
