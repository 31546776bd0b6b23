"""Selection among causes: which ones remain, and which one is removed first."""

from types import SimpleNamespace

import pytest

from rotemina.sim.gap.compare import cause_contest
from rotemina.sim.robot import AxisEffect


def make_explanation(causes):
    ids = tuple((cause.id, None) for cause in causes)
    return SimpleNamespace(causes=tuple(causes), ids=ids, by_tap={}, score=1.0)


@pytest.fixture
def contest(monkeypatch):
    """Return a function that lets causes with weights compete, all of them significant."""

    def run(weights, explain_without_removed, *, disturbed=False):
        explanation = make_explanation([AxisEffect(axis="thy", id=name) for name in weights])
        patches = {
            "_significant": lambda _e, _s, best, ranked, *_, **__: (best, ranked),
            "rivals_of": lambda _e, _s, best: {
                key: (SimpleNamespace(effect=key[0], from_axis=None, probability=1.0),)
                for key in best.ids
            },
            "_doubt": lambda *arguments: weights[arguments[4][0]],
            "_with_only": lambda _e, _s, causes: explain_without_removed(explanation, causes),
        }
        for name, function in patches.items():
            monkeypatch.setattr(cause_contest, name, function)
        selection = SimpleNamespace(raw=9.0, tried=())
        best, _ = cause_contest.contested(
            None, selection, explanation, {}, wanders=False, disturbed=disturbed
        )
        return explanation, best

    return run


def test_a_doubtful_cause_that_returns_in_the_remainder_ends_the_contest(contest):
    weights = {"creep": 0.2, "resonance_mismatch": 0.2}
    explanation, best = contest(weights, lambda explanation, _causes: explanation)
    # It has returned once, and would return for ever.
    assert best is explanation


def test_of_two_doubtful_causes_the_less_likely_one_is_removed_first(contest):
    weights = {"static_nonlinearity": 0.05, "stiffness_nonlinearity": 0.08}
    _, best = contest(weights, lambda _explanation, causes: make_explanation(causes))
    assert best.ids == (("stiffness_nonlinearity", None),)


@pytest.mark.parametrize("disturbed", [False, True])
def test_with_a_disturbance_a_single_cause_is_one_of_several(contest, disturbed):
    nothing = make_explanation([])
    explanation, best = contest(
        {"static_nonlinearity": 0.2}, lambda *_: nothing, disturbed=disturbed
    )
    assert best is (nothing if disturbed else explanation)
