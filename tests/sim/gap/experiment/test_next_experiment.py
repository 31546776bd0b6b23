"""The next experiment: safe, repeatable, and able to distinguish the rivals."""

import sys
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from rotemina.sim.gap.compare import Rival, Selection, explain
from rotemina.sim.gap.examination import AxisExamination
from rotemina.sim.gap.experiment import suggest_experiments
from rotemina.sim.gap.fit import Evidence
from rotemina.sim.gap.result import GapVerdict
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.simulation import simulate
from rotemina.sim.trajectory import dry_run

# The shared records are in a module of the parent folder.
sys.path.insert(0, str(Path(__file__).parents[1]))
from sweeps import ROBOT, make_sines


def measure(effects, record, *, reference=False):
    """Return the response of the machine, by default without a reference, like most records."""
    full_record = simulate(ROBOT, effects, record, np.random.default_rng(0))
    signals = {
        (axis, tap): full_record.signal(axis, tap)
        for axis, tap in full_record.columns
        if tap in (Tap.CMD, Tap.MEAS) or (reference and tap is Tap.REF)
    }
    return Record.from_signals(full_record.time_s, signals, full_record.units)


def make_examination(record, rivals, *, robot=ROBOT, verdict=GapVerdict.EXPLAINED):
    """Return an examination that cannot distinguish rivals, which are fitted to the record."""
    evidence = Evidence.of(robot, rivals[0].axis, [record])
    explanations = [explain(evidence, [rival]) for rival in rivals]
    share = 1.0 / len(rivals)
    ranked = tuple(
        Rival(rival.id, rival.from_axis, share, explanation)
        for rival, explanation in zip(rivals, explanations, strict=True)
    )
    key = rivals[0].id, rivals[0].from_axis
    selection = Selection(explanations[0], explanations[0], explanations[0], tuple(explanations))
    ranking = {key: ranked}
    return AxisExamination(
        evidence, {}, (), selection, explanations[0], verdict, ranking, {}, None, None
    )


def make_zn_effects(*ids):
    return [AxisEffect(axis="zn", id=effect_id) for effect_id in ids]


TRUE_DELAY = AxisEffect(axis="zn", id="delay", parameters={"delay": 3e-3})


@pytest.fixture(scope="module")
def delay_or_lag():
    return make_examination(
        measure([TRUE_DELAY], make_sines()), make_zn_effects("delay", "amplifier_lag")
    )


@pytest.fixture(scope="module")
def experiment(delay_or_lag):
    (experiment,) = suggest_experiments(ROBOT, delay_or_lag)
    return experiment


def make_record(experiment):
    signals = {(axis, Tap.CMD): np.array(command) for axis, command in experiment.commands.items()}
    units = {axis: ROBOT.unit(axis) for axis in experiment.commands}
    return Record.from_signals(np.array(experiment.time_s), signals, units)


def test_the_machine_responds_as_one_of_the_rivals_predicts(experiment):
    assert (experiment.axis, experiment.splits, experiment.tap) == (
        "zn",
        ("delay", "amplifier_lag"),
        Tap.MEAS,
    )
    reading = simulate(ROBOT, [TRUE_DELAY], make_record(experiment), np.random.default_rng(1))
    floor = ROBOT.axes["zn"].sensor.noise_floor
    errors = {
        rival: np.std(reading.signal("zn", Tap.MEAS) - np.array(prediction)) / floor
        for rival, prediction in experiment.predictions.items()
    }
    assert errors["amplifier_lag"] > max(10.0, 5.0 * errors["delay"])
    assert "noise floors" in str(experiment.why)
    assert "delay and amplifier lag" in str(experiment.why)


def test_it_stays_within_all_limits_and_is_short_and_reproducible(experiment, delay_or_lag):
    assert dry_run(ROBOT, make_record(experiment)).allowed
    assert experiment.time_s[-1] <= 30.0
    assert min(later - earlier for earlier, later in pairwise(experiment.time_s)) >= 0.999e-3
    assert suggest_experiments(ROBOT, delay_or_lag) == (experiment,)


def test_without_limits_in_the_robot_file_it_does_not_exceed_the_records():
    axis = replace(ROBOT.axes["zn"], max_speed=None, max_acceleration=None)
    robot = replace(ROBOT, axes={**ROBOT.axes, "zn": axis})
    record = measure([TRUE_DELAY], make_sines())
    (experiment,) = suggest_experiments(
        robot, make_examination(record, make_zn_effects("delay", "amplifier_lag"), robot=robot)
    )
    command, recorded_command = np.array(experiment.commands["zn"]), record.signal("zn", Tap.CMD)
    assert recorded_command.min() <= command.min() < command.max() <= recorded_command.max()
    for order in (1, 2):
        max_recorded = np.abs(np.diff(recorded_command, order)).max() * 1e3**order
        padded = np.pad(command, 2, mode="edge")
        max_new = np.abs(np.diff(padded, order)).max() / experiment.time_s[1] ** order
        assert max_new <= max_recorded * (1.0 + 1e-6)
    assert (
        "because the robot file states no max_speed and max_acceleration for zn" in experiment.why
    )


@pytest.mark.parametrize("verdict", [GapVerdict.NONE, GapVerdict.UNKNOWN])
def test_without_rivals_to_distinguish_there_is_no_experiment(delay_or_lag, verdict):
    assert suggest_experiments(ROBOT, replace(delay_or_lag, verdict=verdict)) == ()
    ((key, ranked),) = delay_or_lag.ranked.items()
    sure = {key: (replace(ranked[0], probability=1.0),)}
    assert suggest_experiments(ROBOT, replace(delay_or_lag, ranked=sure)) == ()


def test_with_poor_records_the_likeliest_effects_are_rivals(delay_or_lag):
    ((key, ranked),) = delay_or_lag.ranked.items()
    sure = {key: (replace(ranked[0], probability=0.99), replace(ranked[1], probability=0.01))}
    poor = replace(delay_or_lag, verdict=GapVerdict.INSUFFICIENT, ranked=sure)
    (experiment,) = suggest_experiments(ROBOT, poor)
    assert experiment.splits == ("delay", "amplifier_lag")


def test_without_candidates_a_rich_experiment_is_suggested(delay_or_lag):
    no_candidates = replace(delay_or_lag, verdict=GapVerdict.INSUFFICIENT, ranked={})
    (experiment,) = suggest_experiments(ROBOT, no_candidates)
    assert (experiment.splits, experiment.predictions) == ((), {})
    assert "many amplitudes and speeds" in str(experiment.why)
    assert dry_run(ROBOT, make_record(experiment)).allowed


def test_rivals_that_the_reading_cannot_distinguish_require_the_reference():
    truth = AxisEffect(axis="zn", id="sensor_gain", parameters={"error": 0.05})
    without_reference, with_reference = (
        suggest_experiments(
            ROBOT,
            make_examination(
                measure([truth], make_sines(), reference=reference),
                make_zn_effects("sensor_gain", "gain_error"),
            ),
        )[0]
        for reference in (False, True)
    )
    assert without_reference.tap is Tap.REF
    assert "if the reference (ref) of zn is recorded too" in str(without_reference.why)
    predictions = (np.array(values) for values in without_reference.predictions.values())
    distance_m = np.ptp(np.subtract(*predictions))
    assert distance_m > 0.02 * np.ptp(without_reference.commands["zn"])
    assert "recorded too" not in str(with_reference.why)


def test_a_rival_that_no_experiment_distinguishes_is_omitted_and_reported():
    record = measure([TRUE_DELAY], make_sines(), reference=True)
    rivals = make_zn_effects("delay", "gain_error", "static_nonlinearity")
    (experiment,) = suggest_experiments(ROBOT, make_examination(record, rivals))
    assert experiment.splits == ("delay", "gain_error")
    assert "no test here distinguishes static nonlinearity from one of them" in str(experiment.why)


def test_for_a_coupling_one_axis_moves_while_the_other_is_held():
    truth = AxisEffect(axis="thx", id="cross_coupling", from_axis="thy")
    thx_commands = make_sines(("thx",))
    signals = {(axis, Tap.CMD): thx_commands.signal("thx", Tap.CMD) for axis in ("thx", "thy")}
    record = Record.from_signals(thx_commands.time_s, signals, {"thx": "rad", "thy": "rad"})
    rivals = [truth, AxisEffect(axis="thx", id="gain_error")]
    (experiment,) = suggest_experiments(ROBOT, make_examination(measure([truth], record), rivals))
    moving = [axis for axis, command in experiment.commands.items() if np.ptp(command) > 0.0]
    assert len(moving) == 1
    assert "cross coupling from thy" in str(experiment.why)
