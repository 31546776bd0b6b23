"""What the data cannot tell from a cause: near rivals, and what imitates it where it is slight."""

from types import SimpleNamespace

import pytest

from rotemina.sim.gap.compare.rivals import Rival, not_ruled_out
from rotemina.sim.robot.model import AxisEffect


def ranked(cause, parameters, others=()):
    """A cause of zn, fitted to such parameters, and rivals with their probabilities."""
    fit = SimpleNamespace(effects=(AxisEffect(axis="zn", id=cause, parameters=parameters),))
    explained = SimpleNamespace(fit=fit, score=1.0)
    left = 1.0 - sum(share for _, share in others)
    return [
        Rival(cause, None, left, explained),
        *(Rival(name, None, share, explained) for name, share in others),
    ]


def test_rivals_near_the_likeliest_are_not_ruled_out():
    own = ranked("creep", {}, [("thermal_drift", 0.2), ("sensor_drift", 0.05)])
    assert not_ruled_out(own, ("creep", None), 100.0) == ("thermal_drift",)


@pytest.mark.parametrize(
    ("error", "damping", "also"),
    [(0.003, 0.02, ("flexible_mode",)), (0.05, 0.02, ()), (0.003, 0.8, ())],
)
def test_a_slight_shift_of_the_resonance_may_be_a_small_mass_on_a_spring(error, damping, also):
    own = ranked("resonance_mismatch", {"frequency_error": error, "damping_error": damping})
    assert not_ruled_out(own, ("resonance_mismatch", None), 100.0) == also


@pytest.mark.parametrize(
    ("own", "other", "also"),
    [(5.0, 4.0, ("friction",)), (5.0, 6.0, ()), (1.2, 1.1, ())],
)
def test_what_closes_more_with_more_parameters_is_not_ruled_out_while_something_is_left(
    own, other, also
):
    ranked = [
        Rival("backlash", None, 0.95, SimpleNamespace(score=own)),
        Rival("friction", None, 0.02, SimpleNamespace(score=other)),
    ]
    assert not_ruled_out(ranked, ("backlash", None), 100.0) == also


@pytest.mark.parametrize(
    ("cause", "left", "other", "also"),
    [
        ("friction", 50.0, 300.0, ("backlash",)),
        ("backlash", 50.0, 300.0, ("friction",)),
        ("friction", 50.0, 1200.0, ()),
        ("friction", 10.0, 300.0, ()),
        ("creep", 50.0, 300.0, ()),
    ],
)
def test_what_sticks_and_what_is_loose_are_kin_where_no_formula_is_right(cause, left, other, also):
    twin = "friction" if cause == "backlash" else "backlash"
    ranked = [
        Rival(cause, None, 0.99, SimpleNamespace(score=left)),
        Rival(twin, None, 0.01, SimpleNamespace(score=other)),
    ]
    assert not_ruled_out(ranked, (cause, None), 1e4) == also
