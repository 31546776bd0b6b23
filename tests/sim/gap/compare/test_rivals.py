"""Rivals that the data cannot distinguish from a cause: near ones, and imitators if it is small."""

from types import SimpleNamespace

import pytest

from rotemina.sim.gap.compare import Rival, not_ruled_out
from rotemina.sim.robot import AxisEffect


def make_rivals(cause, parameters, others=()):
    """Return a cause of zn with fitted parameters, and rivals with their probabilities."""
    fit = SimpleNamespace(effects=(AxisEffect(axis="zn", id=cause, parameters=parameters),))
    explanation = SimpleNamespace(fit=fit, score=1.0)
    probability = 1.0 - sum(share for _, share in others)
    return [
        Rival(cause, None, probability, explanation),
        *(Rival(name, None, share, explanation) for name, share in others),
    ]


def test_rivals_near_the_likeliest_are_not_ruled_out():
    ranked = make_rivals("creep", {}, [("thermal_drift", 0.2), ("sensor_drift", 0.05)])
    assert not_ruled_out(ranked, ("creep", None), 100.0) == ("thermal_drift",)


@pytest.mark.parametrize(
    ("error", "damping", "expected"),
    [(0.003, 0.02, ("flexible_mode",)), (0.05, 0.02, ()), (0.003, 0.8, ())],
)
def test_a_slight_shift_of_the_resonance_may_be_a_small_mass_on_a_spring(error, damping, expected):
    ranked = make_rivals("resonance_mismatch", {"frequency_error": error, "damping_error": damping})
    assert not_ruled_out(ranked, ("resonance_mismatch", None), 100.0) == expected


@pytest.mark.parametrize(
    ("raw", "cause", "score", "rival", "other_score", "expected"),
    [
        # A better rival with more parameters is not ruled out while a gap remains.
        (100.0, "backlash", 5.0, "friction", 4.0, ("friction",)),
        (100.0, "backlash", 5.0, "friction", 6.0, ()),
        (100.0, "backlash", 1.2, "friction", 1.1, ()),
        # Friction and backlash are rivals if no formula fits.
        (1e4, "friction", 50.0, "backlash", 300.0, ("backlash",)),
        (1e4, "backlash", 50.0, "friction", 300.0, ("friction",)),
        (1e4, "friction", 50.0, "backlash", 1200.0, ()),
        (1e4, "friction", 10.0, "backlash", 300.0, ()),
        (1e4, "creep", 50.0, "friction", 300.0, ()),
    ],
)
def test_an_unlikely_rival_is_not_ruled_out_while_a_gap_remains(
    raw, cause, score, rival, other_score, expected
):
    ranked = [
        Rival(cause, None, 0.98, SimpleNamespace(score=score)),
        Rival(rival, None, 0.02, SimpleNamespace(score=other_score)),
    ]
    assert not_ruled_out(ranked, (cause, None), raw) == expected
