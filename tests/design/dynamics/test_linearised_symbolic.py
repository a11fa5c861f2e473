"""The derived transfer function against the paper's appendix, symbol by symbol."""

from dataclasses import fields

import sympy
from force_loop_appendix import published_denominator, published_numerator

from fluxbore.design.dynamics.linearised import FILTERED, ForceLoop, force_transfer

LOOP = ForceLoop(**{field.name: sympy.Symbol(field.name, positive=True) for field in fields(ForceLoop)})


def differences(derived, published):
    return [sympy.expand(ours - theirs) for ours, theirs in zip(derived, published, strict=True)]


def test_the_derived_transfer_function_is_the_appendix():
    """A block, sign or filter of Fig. 22 read otherwise, or a misprint of (36) or (37)."""
    ratio = force_transfer(LOOP)
    assert differences(ratio.numerator, published_numerator(LOOP)) == [0] * 4
    assert differences(ratio.denominator, published_denominator(LOOP)) == [0] * 7


def test_a_filtered_observer_changes_three_coefficients():
    """What the paper's denominator leaves out of a controller that can be built."""
    k, ratio = LOOP, force_transfer(LOOP, FILTERED)
    changed = [0, 0, 0, -k.J * k.g_D * (k.K_e + k.K_l), -k.D_e * k.J * k.g_D, -k.J * k.M * k.g_D, 0]
    found = differences(ratio.denominator, published_denominator(LOOP))
    assert [sympy.expand(ours - theirs) for ours, theirs in zip(found, changed, strict=True)] == [0] * 7
    assert differences(ratio.numerator, published_numerator(LOOP)) == [0] * 4
