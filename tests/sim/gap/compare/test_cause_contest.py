"""Which causes stand against the others, and which one goes first."""

from types import SimpleNamespace

import pytest

from rotemina.sim.gap.compare import cause_contest
from rotemina.sim.robot.model import AxisEffect


@pytest.fixture
def anything_stands(monkeypatch):
    """Take no cause for one that follows a remainder by chance."""
    monkeypatch.setattr(
        cause_contest, "_significant", lambda _e, _s, best, ranked, *_, **__: (best, ranked)
    )


@pytest.mark.usefixtures("anything_stands")
def test_a_doubted_cause_that_comes_back_in_what_is_left_ends_the_contest(monkeypatch):
    keys = (("creep", None), ("resonance_mismatch", None))
    causes = tuple(AxisEffect(axis="x", id=name) for name, _ in keys)
    whole = SimpleNamespace(causes=causes, ids=keys, by_tap={}, score=1.0)
    doubt = SimpleNamespace(from_axis=None, probability=0.2)

    def ranked(_evidence, _selection, best):
        return {key: (SimpleNamespace(effect=key[0], **vars(doubt)),) for key in best.ids}

    returns = iter([whole, whole])
    monkeypatch.setattr(cause_contest, "rivals_of", ranked)
    monkeypatch.setattr(cause_contest, "_doubt", lambda *_: 0.2)
    monkeypatch.setattr(cause_contest, "_with_only", lambda *_: next(returns))
    best, _ = cause_contest.contested(
        None, SimpleNamespace(raw=9.0, tried=()), whole, {}, wanders=False, disturbed=False
    )
    assert best is whole  # which has come back once, and would for ever


@pytest.mark.usefixtures("anything_stands")
def test_of_two_that_are_doubted_the_less_likely_one_goes_first(monkeypatch):
    keys = (("static_nonlinearity", None), ("stiffness_nonlinearity", None))
    causes = tuple(AxisEffect(axis="thy", id=name) for name, _ in keys)
    both = SimpleNamespace(causes=causes, ids=keys, by_tap={}, score=1.0)
    weights = {keys[0]: 0.05, keys[1]: 0.08}

    def ranked(_evidence, _selection, best):
        return {
            key: (SimpleNamespace(effect=key[0], from_axis=None, probability=1.0),)
            for key in best.ids
        }

    def with_only(_evidence, _selection, kept):
        return SimpleNamespace(causes=tuple(kept), ids=tuple((one.id, None) for one in kept))

    monkeypatch.setattr(cause_contest, "rivals_of", ranked)
    monkeypatch.setattr(cause_contest, "_doubt", lambda *asked: weights[asked[4]])
    monkeypatch.setattr(cause_contest, "_with_only", with_only)
    best, _ = cause_contest.contested(
        None, SimpleNamespace(raw=9.0, tried=()), both, {}, wanders=False, disturbed=False
    )
    assert best.ids == keys[1:]


@pytest.mark.usefixtures("anything_stands")
@pytest.mark.parametrize("disturbed", [False, True])
def test_beside_a_disturbance_a_single_cause_is_one_of_several(monkeypatch, disturbed):
    curve = AxisEffect(axis="z", id="static_nonlinearity")
    alone = SimpleNamespace(causes=(curve,), ids=((curve.id, None),), by_tap={}, score=1.0)
    rival = SimpleNamespace(effect=curve.id, from_axis=None, probability=1.0)
    nothing = SimpleNamespace(causes=(), ids=())
    monkeypatch.setattr(
        cause_contest, "rivals_of", lambda _e, _s, best: dict.fromkeys(best.ids, (rival,))
    )
    monkeypatch.setattr(cause_contest, "_doubt", lambda *_: 0.2)
    monkeypatch.setattr(cause_contest, "_with_only", lambda *_: nothing)
    best, _ = cause_contest.contested(
        None, SimpleNamespace(raw=9.0, tried=()), alone, {}, wanders=False, disturbed=disturbed
    )
    assert best is (nothing if disturbed else alone)
