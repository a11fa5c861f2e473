"""Threads against the tables of ISO 724, ISO 228-1 and ISO 273."""

import pytest

from fluxbore.design.threads import PORTS, SCREWS

MM = 1e-3


@pytest.mark.parametrize(
    ("name", "diameter", "core"),
    [("M3", 3.0, 2.459), ("M4", 4.0, 3.242), ("M5", 5.0, 4.134), ("M6", 6.0, 4.917), ("M8", 8.0, 6.647),
     ("M10", 10.0, 8.376), ("M12", 12.0, 10.106)],
)  # fmt: skip
def test_cores_of_screws_are_the_standards(name: str, diameter: float, core: float) -> None:
    """ISO 724's table, to its thousandth of a millimetre."""
    assert SCREWS[name].diameter == pytest.approx(diameter * MM)
    assert SCREWS[name].core == pytest.approx(core * MM, abs=0.5e-6)
    assert SCREWS[name].clearance > SCREWS[name].diameter


def test_pipe_threads_are_the_standards() -> None:
    """ISO 228-1: 28 and 19 threads to the inch, thread's depth 0.640327 of the pitch on both sides."""
    for name, per_inch in (("G1/8", 28), ("G1/4", 19)):
        thread = PORTS[name]
        assert thread.pitch == pytest.approx(25.4 * MM / per_inch, abs=0.5e-6)
        assert thread.core == pytest.approx(thread.diameter - 2 * 0.640327 * thread.pitch, abs=1e-6)
    assert PORTS["M8x1"].core == pytest.approx(6.917 * MM, abs=0.5e-6)


def test_a_tapped_hole_is_written_with_its_depth() -> None:
    assert SCREWS["M5"].tapped(6e-3) == "M5 x 6"
    assert PORTS["G1/8"].tapped(8.25e-3) == "G1/8 x 8.25"
