"""O-rings: the table against AS568's inches, and which ring a groove takes."""

import pytest

from fluxbore.design.o_rings import O_RINGS, designation, fitting
from fluxbore.design.seal_gland import SealGland, designed_gland

MM = 1e-3

INCHES = """
-004 0.070 -006 0.114 -008 0.176 -010 0.239 -011 0.301 -012 0.364 -013 0.426 -014 0.489 -016 0.614 -020 0.864
-024 1.114 -028 1.364 -030 1.614 -040 2.864 -042 3.239 -046 4.239 -050 5.239
-102 0.049 -106 0.174 -109 0.299 -110 0.362 -111 0.424 -112 0.487 -117 0.799 -120 0.987 -124 1.237 -128 1.487
-201 0.171 -206 0.484 -210 0.734 -214 0.984 -218 1.234 -222 1.484
"""


def test_the_table_is_as568s() -> None:
    """Against inner diameters in inches: a size left out moves all that follow."""
    words = INCHES.split()
    by_number = {ring.number: ring for ring in O_RINGS}
    for number, inches in zip(words[::2], words[1::2], strict=True):
        assert by_number[-int(number)].inner_diameter == pytest.approx(float(inches) * 25.4 * MM, abs=0.011 * MM), (
            number
        )


def test_a_groove_takes_the_largest_ring_that_it_stretches() -> None:
    gland = designed_gland(14.3 * MM, 1.78 * MM)
    ring = fitting(gland)
    assert ring is not None
    assert ring.number == 13
    assert 0 <= gland.groove_diameter / ring.inner_diameter - 1 <= 0.05
    assert designation(gland).startswith("O-ring AS568-013, 10.82 mm x 1.78 mm (stretched by ")


def test_a_ring_of_the_standards_size_is_named_alone_and_another_by_its_sizes() -> None:
    own = SealGland(14.3 * MM, 11.1 * MM, 2.4 * MM, 10.82 * MM, 1.78 * MM)
    assert designation(own) == "O-ring AS568-013, 10.82 mm x 1.78 mm"
    other = designed_gland(14.3 * MM, 1.5 * MM)
    assert fitting(other) is None
    assert designation(other).endswith(" x 1.5 mm")
