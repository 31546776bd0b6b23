"""Selection among causes: which ones remain, and which one is removed first."""

from types import SimpleNamespace

import pytest

from rotemina.sim.gap.compare import cause_contest
from rotemina.sim.robot import AxisEffect


@pytest.fixture
def all_causes_significant(monkeypatch):
    """Consider every cause significant, so that none follows a remainder by chance."""
    monkeypatch.setattr(
        cause_contest, "_significant", lambda _e, _s, best, ranked, *_, **__: (best, ranked)
    )


@pytest.mark.usefixtures("all_causes_significant")
def test_a_doubtful_cause_that_returns_in_the_remainder_ends_the_contest(monkeypatch):
    keys = (("creep", None), ("resonance_mismatch", None))
    causes = tuple(AxisEffect(axis="x", id=name) for name, _ in keys)
    explanation = SimpleNamespace(causes=causes, ids=keys, by_tap={}, score=1.0)
    doubtful_rival = SimpleNamespace(from_axis=None, probability=0.2)

    def rank(_evidence, _selection, best):
        return {key: (SimpleNamespace(effect=key[0], **vars(doubtful_rival)),) for key in best.ids}

    remainders = iter([explanation, explanation])
    monkeypatch.setattr(cause_contest, "rivals_of", rank)
    monkeypatch.setattr(cause_contest, "_doubt", lambda *_: 0.2)
    monkeypatch.setattr(cause_contest, "_with_only", lambda *_: next(remainders))
    best, _ = cause_contest.contested(
        None, SimpleNamespace(raw=9.0, tried=()), explanation, {}, wanders=False, disturbed=False
    )
    # It has returned once, and would return for ever.
    assert best is explanation


@pytest.mark.usefixtures("all_causes_significant")
def test_of_two_doubtful_causes_the_less_likely_one_is_removed_first(monkeypatch):
    keys = (("static_nonlinearity", None), ("stiffness_nonlinearity", None))
    causes = tuple(AxisEffect(axis="thy", id=name) for name, _ in keys)
    explanation = SimpleNamespace(causes=causes, ids=keys, by_tap={}, score=1.0)
    weights = {keys[0]: 0.05, keys[1]: 0.08}

    def rank(_evidence, _selection, best):
        return {
            key: (SimpleNamespace(effect=key[0], from_axis=None, probability=1.0),)
            for key in best.ids
        }

    def keep_only(_evidence, _selection, remaining):
        return SimpleNamespace(
            causes=tuple(remaining), ids=tuple((cause.id, None) for cause in remaining)
        )

    monkeypatch.setattr(cause_contest, "rivals_of", rank)
    monkeypatch.setattr(cause_contest, "_doubt", lambda *arguments: weights[arguments[4]])
    monkeypatch.setattr(cause_contest, "_with_only", keep_only)
    best, _ = cause_contest.contested(
        None, SimpleNamespace(raw=9.0, tried=()), explanation, {}, wanders=False, disturbed=False
    )
    assert best.ids == keys[1:]


@pytest.mark.usefixtures("all_causes_significant")
@pytest.mark.parametrize("disturbed", [False, True])
def test_with_a_disturbance_a_single_cause_is_one_of_several(monkeypatch, disturbed):
    nonlinearity = AxisEffect(axis="z", id="static_nonlinearity")
    explanation = SimpleNamespace(
        causes=(nonlinearity,), ids=((nonlinearity.id, None),), by_tap={}, score=1.0
    )
    rival = SimpleNamespace(effect=nonlinearity.id, from_axis=None, probability=1.0)
    no_explanation = SimpleNamespace(causes=(), ids=())
    monkeypatch.setattr(
        cause_contest, "rivals_of", lambda _e, _s, best: dict.fromkeys(best.ids, (rival,))
    )
    monkeypatch.setattr(cause_contest, "_doubt", lambda *_: 0.2)
    monkeypatch.setattr(cause_contest, "_with_only", lambda *_: no_explanation)
    best, _ = cause_contest.contested(
        None,
        SimpleNamespace(raw=9.0, tried=()),
        explanation,
        {},
        wanders=False,
        disturbed=disturbed,
    )
    assert best is (no_explanation if disturbed else explanation)
