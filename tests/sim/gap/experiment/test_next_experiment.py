"""The next experiment: safe, repeatable, and one on which the rivals do part."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from rotemina.sim.gap.compare.explanations import explain
from rotemina.sim.gap.compare.forward_selection import Selection
from rotemina.sim.gap.compare.rivals import Rival
from rotemina.sim.gap.diagnosis import Verdict
from rotemina.sim.gap.examination import Examination
from rotemina.sim.gap.experiment.next_experiment import experiments
from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate
from rotemina.sim.trajectory.dry_run import dry_run

ROBOT = load_robot("rotemina")


def commands(robot=ROBOT, share=0.2, hertz=1.0, rate_hz=1000.0, seconds=4.0, axes=("zn",)):
    """Sines about the middle of the range, each axis a little slower than the one before."""
    time_s = np.arange(round(seconds * rate_hz)) / rate_hz
    signals = {}
    for number, axis in enumerate(axes):
        own = robot.axes[axis]
        wave = np.minimum(time_s, 1.0) * np.sin(2.0 * np.pi * hertz * 0.7**number * time_s)
        signals[axis, Tap.CMD] = sum(own.range) / 2.0 + share * own.span * wave
    units = {axis: robot.unit(axis) for axis in axes}
    return Record.from_signals(time_s, signals, units)


def measured(effects, record, *, reference=False):
    """What the machine answers; without its reference, as most records are."""
    whole = simulate(ROBOT, effects, record, np.random.default_rng(0))
    signals = {
        (axis, tap): whole.signal(axis, tap)
        for axis, tap in whole.columns
        if tap in (Tap.CMD, Tap.MEAS) or (reference and tap is Tap.REF)
    }
    return Record.from_signals(whole.time_s, signals, whole.units)


def examined(record, rivals, *, robot=ROBOT, verdict=Verdict.EXPLAINED):
    """An examination that cannot tell rivals apart, each of which is fitted to the record."""
    evidence = Evidence.of(robot, rivals[0].axis, [record])
    fitted = [explain(evidence, [one]) for one in rivals]
    share = 1.0 / len(rivals)
    ranked = tuple(
        Rival(one.id, one.from_axis, share, own) for one, own in zip(rivals, fitted, strict=True)
    )
    key = rivals[0].id, rivals[0].from_axis
    selection = Selection(fitted[0], fitted[0], fitted[0], tuple(fitted))
    ranking = {key: ranked}
    return Examination(evidence, {}, (), selection, fitted[0], verdict, ranking, {}, None, None)


def on_zn(*ids):
    return [AxisEffect(axis="zn", id=one) for one in ids]


TRUE_DELAY = AxisEffect(axis="zn", id="delay", parameters={"delay": 3e-3})


@pytest.fixture(scope="module")
def delay_or_lag():
    return examined(measured([TRUE_DELAY], commands()), on_zn("delay", "amplifier_lag"))


def as_record(experiment):
    signals = {(axis, Tap.CMD): np.array(own) for axis, own in experiment.commands.items()}
    units = {axis: ROBOT.unit(axis) for axis in experiment.commands}
    return Record.from_signals(np.array(experiment.time_s), signals, units)


def test_the_machine_then_answers_as_one_of_the_rivals_said(delay_or_lag):
    (found,) = experiments(ROBOT, delay_or_lag)
    assert (found.axis, found.splits, found.tap) == ("zn", ("delay", "amplifier_lag"), Tap.MEAS)
    reading = simulate(ROBOT, [TRUE_DELAY], as_record(found), np.random.default_rng(1))
    floor = ROBOT.axes["zn"].sensor.noise_floor
    off = {
        rival: np.std(reading.signal("zn", Tap.MEAS) - np.array(said)) / floor
        for rival, said in found.predictions.items()
    }
    assert off["amplifier_lag"] > max(10.0, 5.0 * off["delay"])
    assert "noise floors" in str(found.why)
    assert "delay and amplifier lag" in str(found.why)


def test_it_is_inside_all_limits_and_of_modest_size(delay_or_lag):
    (found,) = experiments(ROBOT, delay_or_lag)
    assert dry_run(ROBOT, as_record(found)).allowed
    assert found.time_s[-1] <= 30.0
    assert min(later - earlier for earlier, later in pairwise(found.time_s)) >= 0.999e-3


def test_the_same_records_give_the_same_test(delay_or_lag):
    assert experiments(ROBOT, delay_or_lag) == experiments(ROBOT, delay_or_lag)


def test_without_limits_in_the_robot_file_it_asks_for_no_more_than_the_records_show():
    own = replace(ROBOT.axes["zn"], max_speed=None, max_acceleration=None)
    free = replace(ROBOT, axes={**ROBOT.axes, "zn": own})
    record = measured([TRUE_DELAY], commands())
    (found,) = experiments(free, examined(record, on_zn("delay", "amplifier_lag"), robot=free))
    asked, known = np.array(found.commands["zn"]), record.signal("zn", Tap.CMD)
    assert known.min() <= asked.min() < asked.max() <= known.max()
    for order in (1, 2):
        most = np.abs(np.diff(known, order)).max() * 1e3**order
        rested = np.pad(asked, 2, mode="edge")
        new = np.abs(np.diff(rested, order)).max() / found.time_s[1] ** order
        assert new <= most * (1.0 + 1e-6)
    assert "because the robot file states no max_speed and max_acceleration for zn" in found.why


@pytest.mark.parametrize("verdict", [Verdict.NONE, Verdict.UNKNOWN])
def test_where_nothing_is_to_be_split_there_is_no_test(delay_or_lag, verdict):
    assert experiments(ROBOT, replace(delay_or_lag, verdict=verdict)) == ()
    ((key, ranked),) = delay_or_lag.ranked.items()
    sure = {key: (replace(ranked[0], probability=1.0),)}
    assert experiments(ROBOT, replace(delay_or_lag, ranked=sure)) == ()


def test_where_records_are_poor_the_likeliest_effects_are_rivals(delay_or_lag):
    ((key, ranked),) = delay_or_lag.ranked.items()
    sure = {key: (replace(ranked[0], probability=0.99), replace(ranked[1], probability=0.01))}
    poor = replace(delay_or_lag, verdict=Verdict.INSUFFICIENT, ranked=sure)
    (found,) = experiments(ROBOT, poor)
    assert found.splits == ("delay", "amplifier_lag")


def test_where_nothing_was_found_a_rich_test_is_suggested(delay_or_lag):
    nothing = replace(delay_or_lag, verdict=Verdict.INSUFFICIENT, ranked={})
    (found,) = experiments(ROBOT, nothing)
    assert (found.splits, found.predictions) == ((), {})
    assert "many amplitudes and speeds" in str(found.why)
    assert dry_run(ROBOT, as_record(found)).allowed


def test_what_the_reading_cannot_tell_asks_for_the_reference():
    truth = AxisEffect(axis="zn", id="sensor_gain", parameters={"error": 0.05})
    record = measured([truth], commands())
    (found,) = experiments(ROBOT, examined(record, on_zn("sensor_gain", "gain_error")))
    assert found.tap is Tap.REF
    assert "if the reference (ref) of zn is recorded too" in str(found.why)
    apart_m = np.ptp(np.subtract(*(np.array(own) for own in found.predictions.values())))
    assert apart_m > 0.02 * np.ptp(found.commands["zn"])


def test_where_the_reference_is_recorded_nothing_more_is_asked_for():
    truth = AxisEffect(axis="zn", id="sensor_gain", parameters={"error": 0.05})
    record = measured([truth], commands(), reference=True)
    (found,) = experiments(ROBOT, examined(record, on_zn("sensor_gain", "gain_error")))
    assert "recorded too" not in str(found.why)


def test_a_rival_that_no_test_tells_is_left_out_and_said():
    record = measured([TRUE_DELAY], commands(), reference=True)
    rivals = on_zn("delay", "gain_error", "static_nonlinearity")
    (found,) = experiments(ROBOT, examined(record, rivals))
    assert found.splits == ("delay", "gain_error")
    assert "no test here distinguishes static nonlinearity from one of them" in str(found.why)


def test_for_a_coupling_one_of_the_two_axes_moves_while_the_other_is_held():
    truth = AxisEffect(axis="thx", id="cross_coupling", from_axis="thy")
    alone = commands(axes=("thx",))
    signals = {(axis, Tap.CMD): alone.signal("thx", Tap.CMD) for axis in ("thx", "thy")}
    record = Record.from_signals(alone.time_s, signals, {"thx": "rad", "thy": "rad"})
    rivals = [truth, AxisEffect(axis="thx", id="gain_error")]
    (found,) = experiments(ROBOT, examined(measured([truth], record), rivals))
    moving = [axis for axis, command in found.commands.items() if np.ptp(command) > 0.0]
    assert len(moving) == 1
    assert "cross coupling from thy" in str(found.why)
