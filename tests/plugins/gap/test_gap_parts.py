"""What the gap page shows, without a window: cells of the map, proofs, advice."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from rotemina.app.motion.command_memory import CommandMemory
from rotemina.app.motion.compared_run import Run, compared
from rotemina.app.motion.model_in_use import ModelInUse
from rotemina.plugins.gap.diagnosis_answer import Answer
from rotemina.plugins.gap.heat_cell import parts
from rotemina.plugins.gap.requested_motion import told
from rotemina.plugins.gap.unseen_motion_reduction import Shrunk, new_motion, prove
from rotemina.plugins.gap.verdict_advice import advice, readiness
from rotemina.sim.comparison.comparison import compare
from rotemina.sim.excitation.generator import excite
from rotemina.sim.excitation.sines_and_chirps import Multisine
from rotemina.sim.gap.diagnosis import Verdict
from rotemina.sim.gap.errors import GapError
from rotemina.sim.gap.location.regimes import Regime
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")


@pytest.fixture(scope="module")
def answer(diagnosis, record):
    return Answer.of(diagnosis, ["day one.csv"], [record])


# --- cells of the map -------------------------------------------------------------------------


def test_the_parts_behind_a_row_of_the_map_add_up_to_the_gap_meanwhile(answer):
    heat = answer.heats["thx", Tap.MEAS]
    own = [trace for trace in answer.traces["thx"] if trace.tap is Tap.MEAS]
    row = heat.regimes.index(Regime.REVERSAL)
    found = [parts(own, heat, row, band)[0] for band in range(len(heat.edges_hz) - 1)]
    within = sum(part.within for part in found)
    rows = within != 0.0
    assert within[rows] == pytest.approx(own[0].before[rows], rel=1e-9)
    for band, part in enumerate(found):
        assert part.rms == pytest.approx(heat.floors[row][band] * own[0].floor, rel=1e-9)
        assert part.seconds == pytest.approx(rows.sum() * 2e-3, rel=1e-6)


# --- proofs -----------------------------------------------------------------------------------


def test_a_proof_tells_how_far_the_gap_of_each_diagnosed_axis_shrinks(diagnosis, record):
    model = ModelInUse.found_by(diagnosis)

    def proof_of(one):
        return prove(diagnosis, model, Run("tuesday", compare(ROBOT, one)), CommandMemory())

    proof = proof_of(record)
    first = proof.shrunk[0]
    assert first.trace.axis == "thx"
    assert first.times == pytest.approx(first.before / first.after)
    assert first.interval[0] < first.times < first.interval[1]
    assert first.times > 5.0
    thy = next(one for one in proof.shrunk if one.trace.axis == "thy")
    assert thy.times == pytest.approx(1.0, abs=0.7)  # nothing was found there
    only_thy = Record.from_signals(
        record.time_s,
        {("thy", tap): record.signal("thy", tap) for tap in (Tap.CMD, Tap.MEAS)},
        {"thy": "rad"},
    )
    assert {one.trace.axis for one in proof_of(only_thy).shrunk} == {"thy"}


def test_a_run_played_with_the_model_keeps_its_figure(diagnosis, record):
    """The session's model knows commands that the memory may not: one run, one figure."""
    model = ModelInUse.found_by(diagnosis)
    fresh = compared(model, "tuesday", record)
    response = fresh.comparison.response
    known = {("thx", Tap.MEAS): response.signal("thx", Tap.MEAS) + 1e-7}
    carried = replace(response, signals={**response.signals, **known})
    run = replace(fresh, comparison=compare(model.robot, record, response=carried))
    first = prove(diagnosis, model, run, CommandMemory()).shrunk[0]
    assert first.figure == run.gaps["thx", Tap.MEAS]
    assert first.figure != fresh.gaps["thx", Tap.MEAS]


def lively_record():
    """Return a record of thx that shows fast motion as well as slow motion."""
    motion = excite(ROBOT, {"thx": Multisine(amplitude=100e-6, high_hz=200.0)}).record
    return simulate(ROBOT, [], motion, np.random.default_rng(0))


def test_the_new_motion_is_of_the_kind_on_which_the_two_models_differ_most(diagnosis):
    record = lively_record()
    creep = AxisEffect(axis="thx", id="creep")
    lag = AxisEffect(axis="thx", id="amplifier_lag")
    asked = {}
    for effect in (creep, lag):
        axes = {"thx": replace(diagnosis.axes["thx"], fitted=(effect,))}
        motion = new_motion(replace(diagnosis, axes=axes), [record], ["thx"])
        asked[effect.id] = motion.metadata["excitation"]
    assert asked == {"creep": "staircase", "amplifier_lag": "multisine"}


def test_the_new_motion_stays_inside_the_motion_of_the_records(diagnosis, record):
    motion = new_motion(diagnosis, [record], ["thx"])
    asked, known = (each.signal("thx", Tap.CMD) for each in (motion, record))
    assert known.min() <= asked.min() < asked.max() <= known.max()
    for order in (1, 2):
        most = np.abs(np.diff(known, order)).max() / np.diff(record.time_s).mean() ** order
        rested = np.pad(asked, 2, mode="edge")
        new = np.abs(np.diff(rested, order)).max() / np.diff(motion.time_s).mean() ** order
        assert new <= most * (1.0 + 1e-6)


def test_records_at_rest_lead_to_no_new_motion(diagnosis, record):
    still = np.full(len(record.time_s), 1e-4)
    resting = Record.from_signals(record.time_s, {("thx", Tap.CMD): still}, {"thx": "rad"})
    with pytest.raises(GapError, match="the records move none of these axes: θx"):
        new_motion(diagnosis, [resting], ["thx"])


# --- words ------------------------------------------------------------------------------------


@pytest.mark.parametrize("verdict", list(Verdict))
def test_every_verdict_says_what_it_means_and_what_to_do(diagnosis, verdict):
    one = replace(diagnosis.axes["thy"], verdict=verdict)
    means, do = advice(one, has_experiment=False)
    assert means.startswith("What it means: ")
    assert do.startswith("What to do: ")


def test_what_is_not_settled_is_said_with_the_experiment_that_would_settle_it(diagnosis):
    lines = list(advice(diagnosis.axes["thx"], has_experiment=True))
    assert lines[1].startswith("Undecided: creep would explain")
    assert "Play next experiment" in lines[2]


def test_the_page_says_what_comes_next():
    assert readiness(0).startswith("1  Choose records")
    assert readiness(1).startswith("One record is chosen.")
    assert readiness(3).startswith("3 records are chosen.")


def test_a_question_tells_how_far_a_motion_leads_in_the_axis_own_unit():
    time_s = np.array([0.0, 1.0])
    commands = {("thx", Tap.CMD): np.array([1e-4, 2e-4]), ("x", Tap.CMD): np.array([0.01, 0.01])}
    text = told(ROBOT, Record.from_signals(time_s, commands, {"thx": "rad", "x": "m"}))
    assert "It takes 1 s" in text
    assert "θx: 100.0 … 200.0 µrad" in text
    assert "X: rests at 10.0000 mm" in text


@pytest.mark.parametrize(
    ("times", "changed", "worse"), [(0.97, True, False), (0.7, True, True), (0.7, False, False)]
)
def test_a_gap_that_is_hardly_larger_is_not_called_so(times, changed, worse):
    trace = SimpleNamespace(changed=changed)
    assert Shrunk(trace, None, times, (times, times)).worse is worse
