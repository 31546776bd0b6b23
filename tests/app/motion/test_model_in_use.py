"""The model in use: switched at rest, carried on, of one machine, and never a looser guard."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.app.motion.bracketed_model import BracketedModel
from rotemina.app.motion.command_memory import CommandMemory
from rotemina.app.motion.live_model import LiveModel
from rotemina.app.motion.live_models import PreparedModel
from rotemina.app.motion.mailbox import RefusedError
from rotemina.app.motion.model_deviation_watch import DeviationWatch
from rotemina.app.motion.model_in_use import Machine, ModelError, ModelInUse
from rotemina.app.motion.playback import Playback
from rotemina.app.motion.recording.recording_reader import Recording
from rotemina.app.motion.recording.session_recorder import SessionRecorder
from rotemina.app.motion.state import Alarmed, CommandRefused, ModelChanged, PlaybackFinished
from rotemina.drivers.samples import DeviceState, Samples
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.gap.diagnosis import AxisDiagnosis, Diagnosis, Offset, Verdict
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.trajectory.checked_trajectory import accepted

ROBOT = load_robot("rotemina")
LOOP = AxisEffect(axis="zn", id="hysteresis", parameters={"width": 6e-6})
CONTACT = AxisEffect(axis="zn", id="contact", parameters={"place": 3.5e-5, "stiffness": 20.0})
NOISE = AxisEffect(axis="zn", id="sensor_noise", parameters={"rms": 1e-8})
FLOOR = ROBOT.axes["zn"].sensor.noise_floor


def diagnosis(*fitted, robot=ROBOT, offset=None):
    offsets = {Tap.MEAS: None if offset is None else Offset(offset, 1e-9)}
    axis = AxisDiagnosis("zn", Verdict.EXPLAINED, (), fitted=fitted, offsets=offsets)
    return Diagnosis(robot, {"zn": axis})


def corrected(driver, *fitted, offset=None):
    return ModelInUse.corrected_by(diagnosis(*(fitted or (LOOP,)), offset=offset), driver)


def swing(share=0.4, seconds=2.0):
    time_s = np.arange(0.0, seconds, 1e-3)
    low, high = ROBOT.axes["zn"].range
    wave = share * (high - low) * np.sin(2.0 * np.pi * time_s / seconds)
    commands = {("zn", Tap.CMD): (low + high) / 2.0 + wave}
    return Record.from_signals(time_s, commands, {"zn": "m"})


def samples(time_s, way, measured=None):
    command = np.tile([sum(axis.range) / 2.0 for axis in ROBOT.axes.values()], (len(time_s), 1))
    command[:, -1] = way
    measured = command if measured is None else measured
    nothing = np.full(command.shape, np.nan)
    return Samples(time_s, command, measured, nothing, np.full(len(time_s), -1))


def use(stepped, model):
    stepped.session.use_model(model)
    return stepped.step()


@pytest.fixture
def worn(stepped):
    """A simulated machine with a loop that its nominal model lacks."""
    stepped.step(times=3)
    stepped.session.service.set_effects([LOOP])
    stepped.step(times=3)
    return stepped


def played(stepped, share=0.4):
    stepped.events.clear()
    stepped.session.play(accepted(ROBOT, swing(share), stepped.session.setpoint_period_s))
    stepped.until(DeviceState.PLAYING)
    stepped.until_idle()
    return stepped.told(PlaybackFinished)[0]


def gap(finished):
    measured = finished.record.signal("zn", Tap.MEAS)
    told = finished.answers
    return [np.sqrt(np.mean((measured - a[:, 0]) ** 2)) for a in (told.in_use, told.nominal)]


# --- one object -------------------------------------------------------------------------------


def test_a_model_is_one_object_with_an_id_that_its_contents_decide():
    driver = Simulator(ROBOT)
    nominal = ModelInUse.nominal_of(driver)
    one, same, other = corrected(driver), corrected(driver), corrected(driver, offset=1e-7)
    assert nominal.id.startswith("nominal-")
    assert not nominal.corrected
    assert one.id == same.id != other.id
    assert one.robot.effects == (LOOP,)
    assert one.nominal is ROBOT
    with pytest.raises(AttributeError):
        one.id = "another"


def test_what_no_command_foretells_is_left_out():
    model = corrected(Simulator(ROBOT), LOOP, NOISE)
    assert model.effects == (LOOP,)
    with pytest.raises(ModelError, match="nothing that commands can predict"):
        corrected(Simulator(ROBOT), NOISE)


def test_a_diagnosis_of_another_robot_file_is_refused():
    other = replace(ROBOT, name="another")
    with pytest.raises(ModelError, match="diagnose again"):
        ModelInUse.corrected_by(diagnosis(LOOP, robot=other), Simulator(ROBOT))


def test_a_penetration_goes_by_no_contact_like_cause():
    model = corrected(Simulator(ROBOT), LOOP, CONTACT)
    assert model.contact_like == (CONTACT,)
    assert model.robot.effects == (LOOP, CONTACT)
    assert model.without_contact.effects == (LOOP,)


# --- in the session ---------------------------------------------------------------------------


def test_the_corrected_model_is_what_the_session_shows_at_once(worn):
    model = corrected(worn.driver)
    before = gap(played(worn))
    assert before[0] == pytest.approx(before[1])
    state = use(worn, model)
    assert (worn.session.model, state.model_id) == (model, model.id)
    assert [event.model for event in worn.told(ModelChanged)] == [model]
    finished = played(worn, 0.35)
    in_use, nominal = gap(finished)
    assert in_use < 0.05 * nominal
    assert in_use < 3.0 * FLOOR
    assert finished.model is model
    assert finished.record.metadata["model"] == model.id
    assert finished.record.metadata["effects"] == f"{LOOP.axis} {LOOP.id}"
    shown = worn.session.snapshot()
    assert abs(shown.measured["zn"] - shown.model["zn"]) < 6.0 * FLOOR
    assert abs(shown.measured["zn"] - shown.nominal["zn"]) > 20.0 * FLOOR


def test_what_is_sent_does_not_change(make_stepped):
    commands = []
    for corrects in (False, True):
        stepped = make_stepped()
        stepped.step(times=3)
        if corrects:
            use(stepped, corrected(stepped.driver))
        commands.append(played(stepped).record.signal("zn", Tap.CMD))
    np.testing.assert_array_equal(*commands)


def test_back_to_nominal(worn):
    played(worn)
    use(worn, corrected(worn.driver))
    state = use(worn, ModelInUse.nominal_of(worn.driver))
    assert state.model_id.startswith("nominal-")
    assert worn.step().model["zn"] == worn.session.snapshot().nominal["zn"]


def test_it_is_switched_at_rest_only(worn):
    worn.session.jog("zn", 1e-5)
    with pytest.raises(RefusedError, match="still moving"):
        worn.session.use_model(corrected(worn.driver))
    worn.until_idle()
    use(worn, corrected(worn.driver))
    assert worn.session.model.corrected


def test_a_motion_that_has_begun_meanwhile_keeps_the_model(worn):
    model = corrected(worn.driver)
    worn.session.jog("zn", 1e-5)
    prepared = PreparedModel.of(model, CommandMemory())
    # As if it had been asked for a moment before.
    worn.session._link.ask(lambda _, __: worn.session._link.worker.use_model(prepared))
    worn.step()
    assert "still moving" in worn.told(CommandRefused)[0].message
    assert not worn.session.model.corrected


def test_the_gap_begins_anew_at_the_switch(worn):
    played(worn)
    switched_s = worn.session.snapshot().device_time_s
    use(worn, corrected(worn.driver))
    window = worn.session.history.tail()
    assert window.gap_since_s == pytest.approx(switched_s, abs=0.05)
    later = window.device_time_s > window.gap_since_s
    assert (window.model[later, -1] != window.nominal[later, -1]).all()
    np.testing.assert_array_equal(window.model[~later], window.nominal[~later])


def test_a_recording_says_which_model_was_in_use(worn, tmp_path):
    played(worn)
    recorder = SessionRecorder(worn.session, tmp_path / "one.arrows", clock=worn.clock)
    recorder.start(thread=False)
    model = corrected(worn.driver)
    use(worn, model)
    recorder.writer.run_once()
    recording = Recording.open(recorder.close())
    assert recording.metadata["model"].startswith("nominal-")
    assert [one.text for one in recording.events() if one.kind == "model"] == [model.id]


# --- memory -----------------------------------------------------------------------------------


def test_the_past_is_carried_on_over_the_switch(worn):
    """A swing long ago, a rest and another way: the model stands where the machine does."""
    played(worn, 0.49)
    worn.session.jog("zn", -7e-6)
    worn.until_idle()
    worn.step(0.02, 100)
    state = use(worn, corrected(worn.driver))
    assert state.unsettled == ()
    state = worn.step(0.02, 3)
    assert abs(state.measured["zn"] - state.model["zn"]) < 6.0 * FLOOR


def test_a_past_that_is_unknown_is_said_until_a_swing_settles_it(worn):
    use(worn, corrected(worn.driver))
    state = worn.step(0.02, 5)
    assert state.unsettled == ("zn",)
    assert worn.session.history.tail().doubt[-1, -1] > 10.0 * FLOOR
    played(worn, 0.49)
    state = worn.step(0.02, 100)
    assert state.unsettled == ()
    assert worn.session.history.tail().doubt[-1].max() == 0.0


def test_the_truth_lies_within_the_doubt():
    low, high = ROBOT.axes["zn"].range
    time_s = np.arange(0.0, 4.0, 1e-3)
    way = low + (high - low) * (0.5 + 0.1 * np.sin(time_s))
    robot = replace(ROBOT, effects=(LOOP,))
    before = np.interp(time_s, [0.0, 1.0, 3.0, 4.0], [way[0], 0.9 * high, 0.2 * high, way[0]])
    truth = LiveModel(robot)
    truth.answer(time_s - 5.0, samples(time_s, before).command)
    told, doubt = BracketedModel(robot).answer(time_s, samples(time_s, way).command)
    error = np.abs(truth.answer(time_s, samples(time_s, way).command) - told)[:, -1]
    assert (error <= doubt[:, -1] + 1e-10).all()
    assert error.max() > 3.0 * FLOOR


def test_a_model_without_memory_has_no_doubt():
    gain = AxisEffect(axis="zn", id="gain_error", parameters={"error": 0.02})
    model = BracketedModel(replace(ROBOT, effects=(gain,)), {"zn": 3e-7})
    still = samples(np.arange(5) * 1e-3, 3e-5)
    told, doubt = model.answer(still.device_time_s, still.command)
    nominal = LiveModel(ROBOT).answer(still.device_time_s, still.command)
    assert not doubt.any()
    np.testing.assert_allclose(told[:, -1] - nominal[:, -1], 3e-5 * 0.02 + 3e-7, rtol=1e-3)


def test_a_rest_takes_two_rows_of_the_memory_and_a_motion_all_of_its_own():
    memory = CommandMemory()
    time_s = np.arange(10_000) * 1e-3
    way = np.clip(time_s - 4.0, 0.0, 1.0) * 1e-5
    for first in range(0, 10_000, 16):
        part = slice(first, first + 16)
        memory.add(samples(time_s[part], way[part]))
    kept_s, command = memory.history()
    assert 1000 < len(kept_s) < 1300
    assert (kept_s[0], kept_s[-1]) == (time_s[0], time_s[-1])
    np.testing.assert_allclose(np.interp(time_s, kept_s, command[:, -1]), way, atol=1e-12)
    memory.clear()
    assert not len(memory.history()[0])


def test_the_memory_is_bounded():
    memory = CommandMemory(most_rows=500)
    for first in range(0, 2000, 100):
        time_s = np.arange(first, first + 100) * 1e-3
        memory.add(samples(time_s, time_s * 1e-6))
    assert len(memory.history()[0]) <= 601


# --- of one machine ---------------------------------------------------------------------------


def test_another_machine_begins_nominal_and_says_so(worn, clock):
    played(worn)
    use(worn, corrected(worn.driver))
    other = Simulator(ROBOT, clock=clock)
    other.name = "another"
    worn.session.use(other)
    worn.step(times=3)
    changed = worn.told(ModelChanged)[-1]
    assert not changed.model.corrected
    assert "driver" in changed.why
    assert not worn.session.model.corrected


def test_the_same_machine_keeps_its_model_and_knows_nothing_of_the_past(worn):
    played(worn)
    model = corrected(worn.driver)
    use(worn, model)
    worn.session.disconnect()
    worn.step()
    worn.session.connect()
    worn.step(times=3)
    assert worn.session.model is model
    assert worn.session.snapshot().unsettled == ("zn",)


def test_a_model_of_another_machine_is_refused(worn):
    model = corrected(worn.driver)
    other = replace(model, machine=Machine("0" * 64, model.machine.driver))
    use(worn, other)
    assert (
        "belongs to another machine: the robot file has changed"
        in worn.told(CommandRefused)[0].message
    )
    assert not worn.session.model.corrected


# --- protection -------------------------------------------------------------------------------


def test_the_bound_of_a_playback_holds_against_both_models():
    zeros = np.zeros((100, len(ROBOT.axes)))
    readings = zeros.copy()
    readings[:, -1] = 6e-6
    given = samples(np.arange(100) * 1e-3, 0.0, readings)
    for model, nominal in ((readings, zeros), (zeros, readings)):
        assert DeviationWatch(ROBOT, {"zn": 5e-6}).add(given, model, nominal) is not None
    watch = DeviationWatch(ROBOT, {"zn": 5e-6})
    assert watch.add(given, readings, readings) is None
    assert watch.gaps["zn"].rms == 0.0


def test_a_corrected_model_does_not_loosen_stop_beyond(worn):
    played(worn)
    use(worn, corrected(worn.driver))
    told = []
    playback = Playback(worn.session, told.append)
    playback.play(accepted(ROBOT, swing(), worn.session.setpoint_period_s), bounds={"zn": 1e-6})
    worn.until(DeviceState.PLAYING)
    worn.until_idle()
    assert [one.startswith("axis zn deviates") for one in told] == [True]
    playback.close()


def test_the_tip_is_judged_by_the_nominal_model_alone(worn):
    played(worn)
    before = worn.step() and worn.session._link.worker.deviation.now[-1]
    use(worn, corrected(worn.driver))
    after = worn.step(times=3) and worn.session._link.worker.deviation.now[-1]
    assert after == pytest.approx(before, abs=5.0 * FLOOR)
    assert abs(after) > 20.0 * FLOOR


def test_a_fault_while_a_record_was_taken_stands_in_it(worn):
    worn.session.play(swing())
    worn.until(DeviceState.PLAYING)
    worn.session.note_contact("the tip was in contact")
    worn.until_idle()
    assert worn.told(PlaybackFinished)[0].record.metadata["noted"] == "the tip was in contact"
    assert "noted" not in played(worn).record.metadata
    assert not worn.told(Alarmed)
