"""Model in use: switched at rest, with memory, for one machine, and never a looser guard."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.app.errors import ModelError, RequestRefusedError
from rotemina.app.motion.model import (
    BracketedModel,
    CommandMemory,
    DeviationWatch,
    MachineIdentity,
    ModelInUse,
    PreparedModel,
)
from rotemina.app.motion.model.live_model import LiveModel
from rotemina.app.motion.playback import Playback
from rotemina.app.motion.recording import Recording, SessionRecorder
from rotemina.app.motion.state import (
    AlarmRaised,
    CommandRefused,
    ModelChanged,
    PlaybackFinished,
)
from rotemina.drivers.contract import DeviceSamples, DeviceState
from rotemina.drivers.simulator import Simulator
from rotemina.sim.gap.result import (
    AxisDiagnosis,
    Diagnosis,
    GapVerdict,
    ModelOffset,
)
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.trajectory import accept_trajectory

ROBOT = load_robot("rotemina")
LOOP = AxisEffect(axis="zn", id="hysteresis", parameters={"width": 6e-6})
CONTACT = AxisEffect(axis="zn", id="contact", parameters={"place": 3.5e-5, "stiffness": 20.0})
NOISE = AxisEffect(axis="zn", id="sensor_noise", parameters={"rms": 1e-8})
FLOOR = ROBOT.axes["zn"].sensor.noise_floor


def make_diagnosis(*fitted, robot=ROBOT, offset=None):
    offsets = {Tap.MEAS: None if offset is None else ModelOffset(offset, 1e-9)}
    axis = AxisDiagnosis("zn", GapVerdict.EXPLAINED, (), fitted=fitted, offsets=offsets)
    return Diagnosis(robot, {"zn": axis})


def make_corrected_model(driver, *fitted, offset=None):
    return ModelInUse.make_corrected(make_diagnosis(*(fitted or (LOOP,)), offset=offset), driver)


def make_swing(share=0.4, seconds=2.0):
    time_s = np.arange(0.0, seconds, 1e-3)
    low, high = ROBOT.axes["zn"].range
    wave = share * (high - low) * np.sin(2.0 * np.pi * time_s / seconds)
    commands = {("zn", Tap.CMD): (low + high) / 2.0 + wave}
    return Record.from_signals(time_s, commands, {"zn": "m"})


def make_samples(time_s, positions, measured=None):
    command = np.tile([sum(axis.range) / 2.0 for axis in ROBOT.axes.values()], (len(time_s), 1))
    command[:, -1] = positions
    measured = command if measured is None else measured
    no_inputs = np.full(command.shape, np.nan)
    return DeviceSamples(time_s, command, measured, no_inputs, np.full(len(time_s), -1))


def use_model(harness, model):
    harness.session.use_model(model)
    return harness.step()


@pytest.fixture
def machine(harness):
    """A simulated machine with a hysteresis that its nominal model lacks."""
    harness.step(times=3)
    harness.session.service.set_effects([LOOP])
    harness.step(times=3)
    return harness


def play_swing(harness, share=0.4):
    harness.events.clear()
    harness.session.play(
        accept_trajectory(ROBOT, make_swing(share), harness.session.setpoint_period_s)
    )
    harness.step_until(DeviceState.PLAYING)
    harness.step_until_idle()
    return harness.list_events(PlaybackFinished)[0]


def measure_gaps(finished):
    measured = finished.record.signal("zn", Tap.MEAS)
    outputs = finished.model_outputs
    return [
        np.sqrt(np.mean((measured - model[:, 0]) ** 2))
        for model in (outputs.in_use, outputs.nominal)
    ]


def test_a_model_is_known_by_its_contents_and_predicts_like_that_of_its_diagnosis():
    driver = Simulator(ROBOT)
    nominal, model = ModelInUse.make_nominal(driver), make_corrected_model(driver)
    assert nominal.id.startswith("nominal-")
    assert not nominal.is_corrected
    offset_model = make_corrected_model(driver, offset=1e-7)
    assert model.id == make_corrected_model(driver).id != offset_model.id
    assert model.nominal is ROBOT
    with pytest.raises(AttributeError):
        model.id = "another"
    computed = ModelInUse.from_diagnosis(make_diagnosis(LOOP, offset=1e-7))
    assert offset_model.id != computed.id
    assert offset_model.predicts_like(computed)
    for diagnosis in (make_diagnosis(LOOP), make_diagnosis(LOOP, CONTACT, offset=1e-7)):
        assert not offset_model.predicts_like(ModelInUse.from_diagnosis(diagnosis))


def test_a_model_has_the_effects_that_commands_predict_and_can_omit_contact():
    model = make_corrected_model(Simulator(ROBOT), LOOP, CONTACT, NOISE)
    assert model.robot.effects == model.effects == (LOOP, CONTACT)
    assert model.contact_like_effects == (CONTACT,)
    assert model.without_contact.effects == (LOOP,)
    with pytest.raises(ModelError, match="nothing that commands can predict"):
        make_corrected_model(Simulator(ROBOT), NOISE)
    other = replace(ROBOT, name="another")
    with pytest.raises(ModelError, match="diagnose again"):
        ModelInUse.make_corrected(make_diagnosis(LOOP, robot=other), Simulator(ROBOT))


def test_the_session_shows_the_corrected_model_at_once_and_the_nominal_one_again(machine):
    model = make_corrected_model(machine.driver)
    before = measure_gaps(play_swing(machine))
    assert before[0] == pytest.approx(before[1])
    switched_s = machine.session.snapshot().device_time_s
    state = use_model(machine, model)
    assert (machine.session.model, state.model_id) == (model, model.id)
    assert [event.model for event in machine.list_events(ModelChanged)] == [model]
    window = machine.session.history.tail()
    assert window.gap_since_s == pytest.approx(switched_s, abs=0.05)
    is_after_switch = window.device_time_s > window.gap_since_s
    assert (window.model[is_after_switch, -1] != window.nominal[is_after_switch, -1]).all()
    np.testing.assert_array_equal(window.model[~is_after_switch], window.nominal[~is_after_switch])
    finished = play_swing(machine, 0.35)
    in_use, nominal = measure_gaps(finished)
    assert in_use < 0.05 * nominal
    assert in_use < 3.0 * FLOOR
    assert finished.model is model
    assert finished.record.metadata["model"] == model.id
    assert finished.record.metadata["effects"] == f"{LOOP.axis} {LOOP.id}"
    state = machine.session.snapshot()
    assert abs(state.measured["zn"] - state.model["zn"]) < 6.0 * FLOOR
    assert abs(state.measured["zn"] - state.nominal["zn"]) > 20.0 * FLOOR
    state = use_model(machine, ModelInUse.make_nominal(machine.driver))
    assert state.model_id.startswith("nominal-")
    assert machine.step().model["zn"] == machine.session.snapshot().nominal["zn"]


def test_the_model_does_not_change_the_commands(make_harness):
    commands = []
    for with_correction in (False, True):
        harness = make_harness()
        harness.step(times=3)
        if with_correction:
            use_model(harness, make_corrected_model(harness.driver))
        commands.append(play_swing(harness).record.signal("zn", Tap.CMD))
    np.testing.assert_array_equal(*commands)


def test_the_model_is_switched_only_at_rest_and_recordings_name_it(machine, tmp_path):
    model, session = make_corrected_model(machine.driver), machine.session
    recorder = SessionRecorder(session, tmp_path / "one.arrows", clock=machine.clock)
    recorder.start(thread=False)
    session.jog("zn", 1e-5)
    with pytest.raises(RequestRefusedError, match="still moving"):
        session.use_model(model)
    prepared = PreparedModel.of(model, CommandMemory())
    # As if it had been requested a moment earlier.
    session._link.queue_driver_call(lambda _, __: session._link.worker.use_model(prepared))
    machine.step()
    assert "still moving" in machine.list_events(CommandRefused)[0].message
    assert not session.model.is_corrected
    machine.step_until_idle()
    use_model(machine, model)
    assert session.model is model
    recorder.writer.run_once()
    recording = Recording.open(recorder.close())
    assert recording.metadata["model"].startswith("nominal-")
    assert [event.text for event in recording.read_events() if event.kind == "model"] == [model.id]


def test_the_switch_keeps_the_memory_of_the_past(machine):
    """After a swing long ago, a rest and another move, the model agrees with the machine."""
    play_swing(machine, 0.49)
    machine.session.jog("zn", -7e-6)
    machine.step_until_idle()
    machine.step(0.02, 100)
    state = use_model(machine, make_corrected_model(machine.driver))
    assert state.unsettled == ()
    state = machine.step(0.02, 3)
    assert abs(state.measured["zn"] - state.model["zn"]) < 6.0 * FLOOR


def test_an_unknown_past_is_reported_until_a_swing_settles_it(machine):
    use_model(machine, make_corrected_model(machine.driver))
    state = machine.step(0.02, 5)
    assert state.unsettled == ("zn",)
    assert machine.session.history.tail().doubt[-1, -1] > 10.0 * FLOOR
    play_swing(machine, 0.49)
    state = machine.step(0.02, 100)
    assert state.unsettled == ()
    assert machine.session.history.tail().doubt[-1].max() == 0.0


def test_the_true_output_lies_within_the_doubt():
    low, high = ROBOT.axes["zn"].range
    time_s = np.arange(0.0, 4.0, 1e-3)
    positions = low + (high - low) * (0.5 + 0.1 * np.sin(time_s))
    robot = replace(ROBOT, effects=(LOOP,))
    earlier_positions = np.interp(
        time_s, [0.0, 1.0, 3.0, 4.0], [positions[0], 0.9 * high, 0.2 * high, positions[0]]
    )
    truth = LiveModel(robot)
    truth.predict(time_s - 5.0, make_samples(time_s, earlier_positions).command)
    predicted, doubt = BracketedModel(robot).predict(
        time_s, make_samples(time_s, positions).command
    )
    error = np.abs(truth.predict(time_s, make_samples(time_s, positions).command) - predicted)[
        :, -1
    ]
    assert (error <= doubt[:, -1] + 1e-10).all()
    assert error.max() > 3.0 * FLOOR


def test_a_model_without_memory_has_no_doubt():
    gain = AxisEffect(axis="zn", id="gain_error", parameters={"error": 0.02})
    model = BracketedModel(replace(ROBOT, effects=(gain,)), {"zn": 3e-7})
    still = make_samples(np.arange(5) * 1e-3, 3e-5)
    predicted, doubt = model.predict(still.device_time_s, still.command)
    nominal = LiveModel(ROBOT).predict(still.device_time_s, still.command)
    assert not doubt.any()
    np.testing.assert_allclose(predicted[:, -1] - nominal[:, -1], 3e-5 * 0.02 + 3e-7, rtol=1e-3)


def test_a_rest_takes_two_rows_of_the_bounded_memory_and_a_motion_all_rows():
    memory = CommandMemory()
    time_s = np.arange(10_000) * 1e-3
    positions = np.clip(time_s - 4.0, 0.0, 1.0) * 1e-5
    for first in range(0, 10_000, 16):
        section = slice(first, first + 16)
        memory.add(make_samples(time_s[section], positions[section]))
    stored_s, command = memory.read_history()
    assert 1000 < len(stored_s) < 1300
    assert (stored_s[0], stored_s[-1]) == (time_s[0], time_s[-1])
    np.testing.assert_allclose(np.interp(time_s, stored_s, command[:, -1]), positions, atol=1e-12)
    memory.clear()
    assert not len(memory.read_history()[0])
    memory = CommandMemory(max_rows=500)
    for first in range(0, 2000, 100):
        memory.add(make_samples(time_s[first : first + 100], time_s[first : first + 100] * 1e-6))
    assert len(memory.read_history()[0]) <= 601


def test_another_machine_begins_with_the_nominal_model_and_a_reason(machine, clock):
    play_swing(machine)
    use_model(machine, make_corrected_model(machine.driver))
    other = Simulator(ROBOT, clock=clock)
    other.name = "another"
    machine.session.use_driver(other)
    machine.step(times=3)
    event = machine.list_events(ModelChanged)[-1]
    assert not event.model.is_corrected
    assert "driver" in event.why
    assert not machine.session.model.is_corrected


def test_the_same_machine_keeps_its_model_but_not_its_memory(machine):
    play_swing(machine)
    model = make_corrected_model(machine.driver)
    use_model(machine, model)
    machine.session.disconnect()
    machine.step()
    machine.session.connect()
    machine.step(times=3)
    assert machine.session.model is model
    assert machine.session.snapshot().unsettled == ("zn",)


def test_a_model_of_another_machine_is_refused(machine):
    model = make_corrected_model(machine.driver)
    other = replace(model, machine=MachineIdentity("0" * 64, model.machine.driver))
    use_model(machine, other)
    assert (
        "belongs to another machine: the robot file has changed"
        in machine.list_events(CommandRefused)[0].message
    )
    assert not machine.session.model.is_corrected


def test_the_bound_of_a_playback_applies_to_both_models():
    zeros = np.zeros((100, len(ROBOT.axes)))
    readings = zeros.copy()
    readings[:, -1] = 6e-6
    samples = make_samples(np.arange(100) * 1e-3, 0.0, readings)
    for model, nominal in ((readings, zeros), (zeros, readings)):
        assert DeviationWatch(ROBOT, {"zn": 5e-6}).add(samples, model, nominal) is not None
    watch = DeviationWatch(ROBOT, {"zn": 5e-6})
    assert watch.add(samples, readings, readings) is None
    assert watch.gaps["zn"].rms == 0.0


def test_a_corrected_model_does_not_loosen_the_bound_of_a_playback(machine):
    play_swing(machine)
    use_model(machine, make_corrected_model(machine.driver))
    messages = []
    playback = Playback(machine.session, messages.append)
    playback.play(
        accept_trajectory(ROBOT, make_swing(), machine.session.setpoint_period_s),
        bounds={"zn": 1e-6},
    )
    machine.step_until(DeviceState.PLAYING)
    machine.step_until_idle()
    assert [message.startswith("axis zn deviates") for message in messages] == [True]
    playback.close()


def test_only_the_nominal_model_judges_the_tip(machine):
    play_swing(machine)
    deviation = machine.session._link.worker.deviation
    machine.step()
    before = deviation.current_deviation[-1]
    use_model(machine, make_corrected_model(machine.driver))
    machine.step(times=3)
    after = deviation.current_deviation[-1]
    assert after == pytest.approx(before, abs=5.0 * FLOOR)
    assert abs(after) > 20.0 * FLOOR


def test_a_fault_during_a_record_is_noted_in_it(machine):
    machine.session.play(make_swing())
    machine.step_until(DeviceState.PLAYING)
    machine.session.note_contact("the tip was in contact")
    machine.step_until_idle()
    assert (
        machine.list_events(PlaybackFinished)[0].record.metadata["noted"]
        == "the tip was in contact"
    )
    assert "noted" not in play_swing(machine).record.metadata
    assert not machine.list_events(AlarmRaised)
