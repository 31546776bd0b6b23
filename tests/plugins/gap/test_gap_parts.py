"""Parts of the gap page without a window: map cells, gap reductions, advice."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from rotemina.app.motion.model import CommandMemory, ModelInUse
from rotemina.app.motion.playback import ComparedRun, compare_with_model
from rotemina.plugins.gap.answer import DiagnosisAnswer
from rotemina.plugins.gap.answer.heat_cell import find_contributions
from rotemina.plugins.gap.answer.requested_motion import describe_motion
from rotemina.plugins.gap.answer.unseen_motion_reduction import (
    GapReduction,
    make_new_motion,
    measure_reductions,
)
from rotemina.plugins.gap.answer.verdict_advice import describe_next_step, explain_verdict
from rotemina.sim.comparison import compare
from rotemina.sim.errors import GapError
from rotemina.sim.excitation import MultisineExcitation, excite
from rotemina.sim.gap.location import OperatingRegime
from rotemina.sim.gap.result import GapVerdict
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate
from rotemina.sim.trajectory import dry_run

ROBOT = load_robot("rotemina")


@pytest.fixture(scope="module")
def answer(diagnosis, record):
    return DiagnosisAnswer.from_diagnosis(diagnosis, ["day one.csv"], [record])


def test_the_parts_of_a_map_row_add_up_to_the_gap(answer):
    heat = answer.heat_maps["thx", Tap.MEAS]
    traces = [trace for trace in answer.traces["thx"] if trace.tap is Tap.MEAS]
    row = heat.regimes.index(OperatingRegime.REVERSAL)
    contributions = [
        find_contributions(traces, heat, row, band)[0] for band in range(len(heat.edges_hz) - 1)
    ]
    total = sum(contribution.gap_in_cell for contribution in contributions)
    in_regime = total != 0.0
    assert total[in_regime] == pytest.approx(traces[0].gap_before[in_regime], rel=1e-9)
    for band, contribution in enumerate(contributions):
        assert contribution.rms == pytest.approx(heat.floors[row][band] * traces[0].floor, rel=1e-9)
        assert contribution.duration_s == pytest.approx(in_regime.sum() * 2e-3, rel=1e-6)


def test_reductions_are_measured_for_each_diagnosed_axis(diagnosis, record):
    model = ModelInUse.from_diagnosis(diagnosis)

    def measure(played_record):
        run = ComparedRun("tuesday", compare(ROBOT, played_record))
        return measure_reductions(diagnosis, model, run, CommandMemory()).reductions

    reductions = measure(record)
    first = reductions[0]
    assert first.trace.axis == "thx"
    assert first.factor == pytest.approx(first.before / first.after)
    assert first.interval[0] < first.factor < first.interval[1]
    assert first.factor > 5.0
    thy = next(reduction for reduction in reductions if reduction.trace.axis == "thy")
    assert thy.factor == pytest.approx(1.0, abs=0.7)  # no cause was found on this axis
    only_thy = Record.from_signals(
        record.time_s,
        {("thy", tap): record.signal("thy", tap) for tap in (Tap.CMD, Tap.MEAS)},
        {"thy": "rad"},
    )
    assert {reduction.trace.axis for reduction in measure(only_thy)} == {"thy"}


def test_the_reduction_uses_the_figure_of_the_run_itself(diagnosis, record):
    """Use the figure of the run: the session's model may know commands that the memory lacks."""
    model = ModelInUse.from_diagnosis(diagnosis)
    original_run = compare_with_model(model, "tuesday", record)
    response = original_run.comparison.response
    changed_signal = {("thx", Tap.MEAS): response.signal("thx", Tap.MEAS) + 1e-7}
    changed_response = replace(response, signals={**response.signals, **changed_signal})
    run = replace(original_run, comparison=compare(model.robot, record, response=changed_response))
    first = measure_reductions(diagnosis, model, run, CommandMemory()).reductions[0]
    assert first.figure == run.gaps["thx", Tap.MEAS]
    assert first.figure != original_run.gaps["thx", Tap.MEAS]


def make_record_with_fast_motion():
    """Return a record of thx with both fast and slow motion."""
    motion = excite(ROBOT, {"thx": MultisineExcitation(amplitude=100e-6, high_hz=200.0)}).record
    return simulate(ROBOT, [], motion, np.random.default_rng(0))


def test_the_new_motion_is_one_on_which_the_two_models_differ_most(diagnosis):
    record = make_record_with_fast_motion()
    creep = AxisEffect(axis="thx", id="creep")
    lag = AxisEffect(axis="thx", id="amplifier_lag")
    excitations = {}
    for effect in (creep, lag):
        axes = {"thx": replace(diagnosis.axes["thx"], fitted=(effect,))}
        motion = make_new_motion(replace(diagnosis, axes=axes), [record], ["thx"])
        excitations[effect.id] = motion.metadata["excitation"]
    assert excitations == {"creep": "staircase", "amplifier_lag": "multisine"}


def test_the_new_motion_stays_within_range_speed_and_acceleration_of_the_records(diagnosis, record):
    motion = make_new_motion(diagnosis, [record], ["thx"])
    new_command, old_command = (
        record_with_command.signal("thx", Tap.CMD) for record_with_command in (motion, record)
    )
    assert dry_run(ROBOT, motion).allowed
    assert old_command.min() <= new_command.min() < new_command.max() <= old_command.max()
    for order in (1, 2):
        old_maximum = (
            np.abs(np.diff(old_command, order)).max() / np.diff(record.time_s).mean() ** order
        )
        padded_command = np.pad(new_command, 2, mode="edge")
        new_maximum = (
            np.abs(np.diff(padded_command, order)).max() / np.diff(motion.time_s).mean() ** order
        )
        assert new_maximum <= old_maximum * (1.0 + 1e-6)


def test_no_new_motion_is_made_from_records_at_rest(diagnosis, record):
    constant_command = np.full(len(record.time_s), 1e-4)
    resting = Record.from_signals(
        record.time_s, {("thx", Tap.CMD): constant_command}, {"thx": "rad"}
    )
    with pytest.raises(GapError, match="the records move none of these axes: θx"):
        make_new_motion(diagnosis, [resting], ["thx"])


def test_every_verdict_is_explained_with_an_action(diagnosis):
    for verdict in GapVerdict:
        axis_diagnosis = replace(diagnosis.axes["thy"], verdict=verdict)
        meaning, action = explain_verdict(axis_diagnosis, has_experiment=False)
        assert meaning.startswith("What it means: ")
        assert action.startswith("What to do: ")


def test_an_undecided_axis_is_explained_with_a_suggested_experiment(diagnosis):
    lines = list(explain_verdict(diagnosis.axes["thx"], has_experiment=True))
    assert lines[1].startswith("Undecided: creep would explain")
    assert "Play next experiment" in lines[2]
    assert describe_next_step(1).startswith("One record is chosen.")
    assert describe_next_step(3).startswith("3 records are chosen.")


def test_a_motion_is_described_with_its_range_in_the_unit_of_each_axis():
    time_s = np.array([0.0, 1.0])
    commands = {("thx", Tap.CMD): np.array([1e-4, 2e-4]), ("x", Tap.CMD): np.array([0.01, 0.01])}
    text = describe_motion(ROBOT, Record.from_signals(time_s, commands, {"thx": "rad", "x": "m"}))
    assert "It takes 1 s" in text
    assert "θx: 100.0 … 200.0 µrad" in text
    assert "X: rests at 10.0000 mm" in text


@pytest.mark.parametrize(
    ("factor", "changed", "is_worse"), [(0.97, True, False), (0.7, True, True), (0.7, False, False)]
)
def test_a_hardly_larger_gap_is_not_called_worse(factor, changed, is_worse):
    trace = SimpleNamespace(is_corrected=changed)
    assert GapReduction(trace, None, factor, (factor, factor)).is_worse is is_worse
