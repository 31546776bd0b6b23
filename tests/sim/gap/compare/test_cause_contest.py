"""What stands in a cause's place, and in which form."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.linalg import eigh

from rotemina.sim.effects.attachment import Attached
from rotemina.sim.gap.compare import cause_contest
from rotemina.sim.gap.compare.cause_contest import _alike, _loads, _twins
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect


@pytest.fixture
def anything_stands(monkeypatch):
    """Take no cause for one that follows a remainder by chance."""
    monkeypatch.setattr(
        cause_contest, "_beyond_chance", lambda _e, _s, best, ranked, *_: (best, ranked)
    )


def test_a_twin_has_the_form_of_its_cause_and_its_numbers():
    cause = AxisEffect(
        axis="x",
        id="static_nonlinearity",
        formulation="series",
        parameters={"begin": 0.2, "end": 0.9, "sine_1": 1e-4, "sine_2": 0.0, "sine_3": 0.0},
    )
    twin = _alike(cause, "sensor_nonlinearity")
    assert (twin.id, twin.formulation) == ("sensor_nonlinearity", "series")
    assert twin.parameters == cause.parameters
    gain = AxisEffect(axis="x", id="gain_error", parameters={"error": 0.02})
    assert _alike(gain, "sensor_gain").parameters == {"error": 0.02}


def test_a_twin_whose_bounds_are_closer_begins_at_them():
    robot = load_robot("rotemina")
    evidence = SimpleNamespace(robot=robot, axis="x", has=lambda tap: False)
    waves = {"period": 1e-3, "sine": 2e-6, "cosine": -1.4e-5, "sine_2": 0.0, "cosine_2": 0.0}
    cause = AxisEffect(axis="x", id="leadscrew_error", parameters=waves)
    Attached.of(robot, cause)
    (twin,) = _twins(evidence, cause)
    begun = Attached.of(robot, twin)  # refuses what is beyond
    assert twin.id == "encoder_interpolation"
    assert begun.values["cosine"] == -1e-5
    assert begun.values["sine"] == 2e-6


def test_a_delay_is_a_lag_of_the_third_order_as_well():
    evidence = SimpleNamespace(robot=load_robot("rotemina"), axis="x", has=lambda tap: True)
    cause = AxisEffect(axis="x", id="delay", parameters={"delay": 4e-4})
    (lag,) = _twins(evidence, cause)
    values = Attached.of(evidence.robot, lag).values
    late_s = values["time_constant"] * (2.0 * values["damping_ratio"] + values["ratio"])
    assert (lag.id, late_s) == ("amplifier_lag", pytest.approx(4e-4))
    evidence.has = lambda tap: False
    assert [one.id for one in _twins(evidence, cause)] == ["sensor_lag", "amplifier_lag"]


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


@pytest.mark.parametrize("off", [-0.03, -0.18])
def test_a_load_that_rings_as_slow_as_a_retuned_resonance(off):
    robot = load_robot("rotemina")
    evidence = SimpleNamespace(robot=robot, axis="x")
    cause = AxisEffect(axis="x", id="resonance_mismatch", parameters={"frequency_error": off})
    (load,) = _loads(evidence, cause)
    own = robot.axes["x"].inertia
    mass = own.mass * load.parameters["mass_ratio"]
    spring = mass * (2.0 * np.pi * load.parameters["frequency"]) ** 2
    stiff = np.array([[own.stiffness + spring, -spring], [-spring, spring]])
    slowest = np.sqrt(eigh(stiff, np.diag([own.mass, mass]), eigvals_only=True)[0])
    assert slowest == pytest.approx((1.0 + off) * np.sqrt(own.stiffness / own.mass), rel=1e-9)


def test_no_load_makes_an_axis_ring_faster():
    cause = AxisEffect(axis="x", id="resonance_mismatch", parameters={"frequency_error": 0.1})
    assert _loads(SimpleNamespace(robot=load_robot("rotemina"), axis="x"), cause) == []
