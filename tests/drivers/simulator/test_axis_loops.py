"""A loop on the simulated machine matches the loop simulation and causes no jumps."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.drivers.abilities import MotionProfile, ProfileSegment
from rotemina.drivers.contract import DeviceState, LimitError, StateError, VirtualClock
from rotemina.drivers.simulator import Simulator, axis_inverses
from rotemina.sim.compensate import InverseModel, find_rest
from rotemina.sim.errors import UnstableError
from rotemina.sim.feedback import (
    AxisLoop,
    AxisRegulation,
    ControllerGains,
    FeedForward,
    NotchFilter,
    compute_lead_taps,
    regulated_plant,
)
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot

RATE_HZ, ZN = 5000.0, 5
GAINS = ControllerGains(
    proportional=0.07,
    integral=1100.0,
    double_integral=300e3,
    derivative=1.7e-4,
    derivative_filter_s=4e-5,
    low_pass_hz=2000.0,
    notch=NotchFilter(420.0, 0.8, 0.03),
    tracking_s=2e-3,
)
WORN = (
    AxisEffect(axis="zn", id="hysteresis", parameters={"width": 0.12 * 65e-6}),
    AxisEffect(axis="zn", id="creep", parameters={"rate": 0.02}),
)
NOISY = replace(load_robot("rotemina"), effects=WORN)
AXIS = NOISY.axes["zn"]
QUIET = replace(NOISY, axes={**NOISY.axes, "zn": replace(AXIS, sensor=None)})


MODEL = InverseModel(
    axis="zn",
    unit="m",
    kind="prandtl_ishlinskii",
    sample_s=1e-3,
    origin=0.0,
    command_origin=0.0,
    span=AXIS.span,
    desired_range=(2e-6, 60e-6),
    command_range=AXIS.range,
    speed=1.0,
    consequents=np.array([[0.0, 0.9, 0.1]]),
    radii=np.array([0.1]),
    initial=np.zeros(1),
)


class LoopBench:
    """A simulator with a manual clock, which is read every 20 ms."""

    def __init__(self, robot=NOISY, *, is_closed=True, **settings):
        self.clock = VirtualClock(3.0)
        self.driver = Simulator(robot, settings, clock=self.clock)
        self.driver.open()
        self.loop = AxisRegulation(robot, "zn", GAINS, RATE_HZ)
        self.samples = []
        self.run(0.1)
        if is_closed:
            self.close_loop()

    def run(self, time_s):
        """Run, and return time, command, voltage and reading (n,) of nano Z."""
        portions = []
        for _ in range(max(round(time_s / 0.02), 1)):
            self.clock.advance(0.02)
            portions.append(self.driver.read())
        self.samples += portions
        return tuple(
            np.concatenate([read_column(portion) for portion in portions])
            for read_column in (
                lambda portion: portion.device_time_s,
                lambda portion: portion.command[:, ZN],
                lambda portion: portion.inputs[:, ZN] * AXIS.gain,
                lambda portion: portion.measured[:, ZN],
            )
        )

    def close_loop(self):
        self.driver.regulate("zn", self.loop)
        assert list(self.driver.closed_loops) == ["zn"]


def make_trajectory(path, interval_s=1e-3):
    time_s = interval_s * np.arange(len(path))
    return Record.from_signals(time_s, {("zn", Tap.CMD): path}, {"zn": "m"})


def run_two_moves(sample_rate_hz):
    """Close the loop, and change the target during a move. Return the traces (n,) of `run`."""
    machine = LoopBench(QUIET, sample_rate_hz=sample_rate_hz)
    first = machine.run(0.02)
    machine.driver.move_to({"zn": 47e-6})
    machine.clock.advance(0.002)
    machine.driver.move_to({"zn": 20e-6})
    return tuple(np.concatenate(pair) for pair in zip(first, machine.run(0.1), strict=True))


def test_the_live_trace_matches_the_simulated_loop_in_every_sample():
    _, reference, output, reading = run_two_moves(5000.0)
    feed_forward = FeedForward(compute_lead_taps(AXIS, 1.0 / RATE_HZ))
    traces = AxisLoop(QUIET, "zn", RATE_HZ).follow(GAINS, reference, feed_forward=feed_forward)
    np.testing.assert_allclose(reading, traces.reading, rtol=0.0, atol=1e-14)
    np.testing.assert_allclose(output, traces.output, rtol=0.0, atol=1e-14)
    # The loop has to correct something.
    assert np.ptp(output - reference) > 1e-6


def test_a_slower_sample_rate_runs_the_same_loop():
    fine, coarse = run_two_moves(5000.0), run_two_moves(1000.0)
    np.testing.assert_allclose(np.diff(coarse[0]), 1e-3, rtol=1e-6)
    indices = [int(np.argmin(np.abs(fine[0] - time_s))) for time_s in coarse[0]]
    for fine_trace, coarse_trace in zip(fine, coarse, strict=True):
        np.testing.assert_allclose(fine_trace[indices], coarse_trace, rtol=0.0, atol=1e-13)


def test_nothing_jumps_when_a_loop_is_closed_or_opened():
    machine = LoopBench(is_closed=False)
    machine.driver.move_to({"zn": 45e-6})
    _, _, output_before, reading_before = machine.run(0.5)
    machine.close_loop()
    _, command, output, reading = machine.run(0.1)
    noise = 5 * AXIS.sensor.noise_rms + AXIS.sensor.resolution
    assert command[-1] == reading_before[-1]
    # Because of hysteresis, the axis never reached its target.
    assert abs(command[-1] - 45e-6) > 1e-6
    assert np.abs(output - output_before[-1]).max() < 4 * noise
    assert np.abs(reading - reading_before[-1]).max() < 2 * noise
    machine.driver.move_to({"zn": 30e-6})
    held_output = machine.run(0.5)[2][-1]
    machine.driver.regulate("zn", None)
    assert machine.driver.closed_loops == {}
    time_s, command, output, _ = machine.run(0.1)
    assert np.abs(output - held_output).max() < 2 * noise
    assert np.ptp(output) == 0.0
    np.testing.assert_allclose(command, output, rtol=0.0, atol=1e-18)
    np.testing.assert_allclose(np.diff(time_s), 1e-3, rtol=1e-6)


def test_a_stop_during_a_move_brakes_the_axis_in_its_loop():
    machine = LoopBench()
    machine.driver.move_to({"zn": 60e-6})
    machine.clock.advance(0.003)
    machine.driver.stop()
    _, command, output, reading = machine.run(0.2)
    assert machine.driver.status().state is DeviceState.IDLE
    assert 33e-6 < command[-1] < 59e-6
    assert np.abs(np.diff(command)).max() <= AXIS.max_speed * 1e-3 * (1 + 1e-9)
    assert abs(reading[-50:].mean() - command[-1]) < 10e-9
    # The output of the amplifier does not jump.
    assert np.abs(np.diff(output)).max() < 6e-6
    assert list(machine.driver.closed_loops) == ["zn"]


def test_a_stop_during_a_trajectory_brakes_from_the_present_speed():
    machine = LoopBench()
    path = 32e-6 + 20e-6 * np.sin(2 * np.pi * 5.0 * 1e-3 * np.arange(2000))
    machine.driver.play(make_trajectory(path))
    machine.run(0.8)
    assert machine.driver.status().state is DeviceState.PLAYING
    machine.driver.stop()
    _, command, _, _ = machine.run(0.2)
    steps = np.diff(np.concatenate([machine.samples[-51].command[-2:, ZN], command]))
    assert np.abs(np.diff(steps)).max() <= AXIS.max_acceleration * 1e-6 * 1.01
    assert machine.driver.status().state is DeviceState.IDLE


def test_outputs_stay_in_range_and_limited_loops_are_reported():
    machine = LoopBench()
    machine.driver.move_to({"zn": 60e-6})
    machine.run(0.4)
    # Because of hysteresis, this target needs an output below the range.
    machine.driver.move_to({"zn": 0.0})
    _, _, output, _ = machine.run(0.6)
    assert output.min() == 0.0
    assert machine.driver.limited_axes == ("zn",)
    machine.driver.move_to({"zn": 40e-6})
    _, command, _, reading = machine.run(0.4)
    # The integrators have not wound up.
    assert abs(reading[-50:].mean() - command[-1]) < 10e-9
    assert machine.driver.limited_axes == ()
    with pytest.raises(LimitError, match="outside its range"):
        machine.driver.move_to({"zn": 66e-6})
    with pytest.raises(LimitError, match=r"the loop of axis .* sets its voltage"):
        machine.driver.set_voltage("zn", 50.0)


def test_rows_of_a_trajectory_are_followed_and_numbered():
    machine = LoopBench()
    path = 32e-6 + 20e-6 * np.sin(2 * np.pi * 10.0 * 1e-3 * np.arange(400))
    machine.driver.play(make_trajectory(path))
    machine.run(1.2)
    rows = np.concatenate([portion.playback_row for portion in machine.samples])
    command, reading = (
        np.concatenate([getattr(portion, name)[:, ZN] for portion in machine.samples])
        for name in ("command", "measured")
    )
    is_playback_row = rows >= 0
    assert rows[is_playback_row].tolist() == list(range(400))
    np.testing.assert_allclose(command[is_playback_row], path, rtol=0.0, atol=1e-18)
    error = (reading[is_playback_row] - path)[100:]
    assert np.sqrt(np.mean(error**2)) < 1e-3 * AXIS.span  # 65 nm, including 12 nm of noise
    assert machine.driver.status().state is DeviceState.IDLE


def test_a_profile_keeps_its_duration_and_an_earlier_one_is_dropped():
    machine = LoopBench(is_closed=False)
    profile = MotionProfile("zn", (ProfileSegment(0.1, 0.0, 6e-6, -4e-6),))
    machine.driver.upload(profile)
    machine.close_loop()
    with pytest.raises(StateError, match="upload one first"):
        machine.driver.trigger()
    machine.driver.upload(profile)
    start = machine.run(0.02)[1][-1]
    machine.driver.trigger()
    _, command, _, _ = machine.run(0.2)
    assert np.argmax(command == command[-1]) == pytest.approx(100, abs=2)
    assert command[-1] == pytest.approx(start + 2e-6, abs=1e-12)


def test_the_change_between_inverse_and_loop_is_smooth():
    machine = LoopBench(is_closed=False)
    machine.driver.compensate("zn", MODEL)
    output_before = machine.run(0.02)[2][-1]
    machine.close_loop()
    _, command, output, reading = machine.run(0.1)
    assert np.abs(output - output_before).max() < 0.3e-6
    assert abs(reading[-50:].mean() - command[-1]) < 10e-9
    machine.driver.compensate("zn", None)
    machine.driver.compensate("zn", MODEL)
    _, command_again, output_again, _ = machine.run(0.1)
    assert np.abs(output_again - output[-1]).max() < 0.3e-6
    assert command_again[-1] == command[-1]
    assert set(machine.driver.compensated_axes) == {"zn"}
    machine.driver.move_to({"zn": 50e-6})
    held_output = machine.run(0.3)[2][-1]
    machine.driver.regulate("zn", None)
    _, _, output, _ = machine.run(0.05)
    assert output[-1] == pytest.approx(held_output, abs=1e-7)
    assert set(machine.driver.compensated_axes) == {"zn"}


def test_a_new_connection_opens_the_loop_and_keeps_its_output():
    machine = LoopBench()
    machine.driver.move_to({"zn": 50e-6})
    held_output = machine.run(0.3)[2][-1]
    machine.driver.close()
    assert machine.driver.closed_loops == {}
    machine.driver.open()
    machine.run(0.05)
    output = machine.samples[-1].inputs[-1, ZN] * AXIS.gain
    assert output == pytest.approx(held_output, abs=1e-7)


def test_a_loop_that_may_not_be_closed_is_refused_with_the_reason():
    with pytest.raises(UnstableError, match="unstable, its largest pole"):
        AxisRegulation(NOISY, "zn", replace(GAINS, integral=6000.0), RATE_HZ)
    # Stable with the nominal axis, but too close to instability if a parameter is off by 5 %.
    aggressive_gains = replace(GAINS, integral=1300.0)
    AxisRegulation(NOISY, "zn", aggressive_gains, RATE_HZ, spread=0.0)
    with pytest.raises(UnstableError, match=r"Ms = .* \(with gain or resonance off by 5 %"):
        AxisRegulation(NOISY, "zn", aggressive_gains, RATE_HZ)
    machine = LoopBench(is_closed=False)
    with pytest.raises(LimitError, match="at 5000 Hz: the simulated machine samples at 3000 Hz"):
        LoopBench(sample_rate_hz=3000.0)
    with pytest.raises(LimitError, match="the loop is for axis zn, not for thx"):
        machine.driver.regulate("thx", machine.loop)
    machine.driver.move_to({"zn": 40e-6})
    with pytest.raises(StateError, match="while it is moving"):
        machine.driver.regulate("zn", machine.loop)
    machine.run(0.2)
    other_robot = replace(NOISY, axes={**NOISY.axes, "zn": replace(AXIS, max_speed=1e-3)})
    with pytest.raises(LimitError, match="was checked for stability on robot"):
        machine.driver.regulate("zn", AxisRegulation(other_robot, "zn", GAINS, RATE_HZ))
    assert machine.driver.closed_loops == {}


@pytest.mark.parametrize("with_delay", [False, True])
def test_a_loop_without_response_is_opened_and_keeps_its_output(with_delay, monkeypatch):
    machine = LoopBench()
    output_before = machine.run(0.1)[2][-1]
    delay = (AxisEffect(axis="zn", id="delay", parameters={"delay": 1e-3}),) if with_delay else ()
    machine.driver.set_effects((*WORN, *delay))
    # With this limit, even the noise counts as a large error.
    monkeypatch.setattr(regulated_plant, "_MAX_ERROR_SHARE", 1e-6)
    # The target is between two steps of the sensor.
    machine.driver.move_to({"zn": 33.0017e-6})
    machine.run(0.1)
    status = machine.driver.status()
    assert status.state is DeviceState.FAULT
    assert "axis zn: its loop was opened because the axis does not respond" in status.fault
    machine.driver.clear_fault()
    assert machine.driver.closed_loops == {}
    output = machine.run(0.1)[2]
    assert output[-1] == pytest.approx(output_before, abs=1.5e-6)
    assert np.ptp(output) < 1e-15


def test_a_delay_set_during_operation_is_simulated():
    machine = LoopBench()
    delay = AxisEffect(axis="zn", id="delay", parameters={"delay": 3e-4})
    machine.driver.set_effects((*WORN, delay))
    machine.driver.move_to({"zn": 45e-6})
    _, command, output, reading = machine.run(0.3)
    assert abs(reading[-50:].mean() - command[-1]) < 20e-9
    assert output.max() <= AXIS.range[1]


def test_the_loop_of_a_stopped_axis_changes_its_output_within_a_bound():
    machine = LoopBench(QUIET)
    machine.driver.stop()
    machine.run(0.1)
    (controller,) = machine.driver._open_device._loops._controllers.values()
    held_output = controller.output
    max_change = 0.35 * AXIS.span
    wrong_reading = held_output - 0.9 * max_change
    outputs = [controller.respond_to_sample(held_output, wrong_reading) for _ in range(500)]
    assert max(outputs) == pytest.approx(held_output + max_change)


def test_the_loop_of_a_stopped_axis_ignores_readings_out_of_bounds(monkeypatch):
    # Without this check, such a loop is not opened.
    monkeypatch.setattr(regulated_plant, "_check_response", lambda *_: None)
    machine = LoopBench(QUIET)
    machine.driver.stop()
    machine.run(0.1)
    device = machine.driver._open_device
    (controller,) = device._loops._controllers.values()
    reference, held_output = float(device.command[ZN]), controller.output
    for error in (1.1 * 0.35 * AXIS.span, -AXIS.span, float("nan")):
        outputs = {controller.respond_to_sample(reference, reference + error) for _ in range(50)}
        assert outputs == {held_output}
    # The compiled loop behaves like the sampled one, here with a reference that is too far away.
    elsewhere = np.array([*device.command[:ZN], reference + 0.4 * AXIS.span])
    device._setpoints.take_over(elsewhere, np.zeros(ZN + 1))
    device.advance(device.time_s + 0.004)
    assert device.command[ZN] == elsewhere[ZN]
    assert device.actuator_command[ZN] == held_output


def test_a_stopped_axis_can_move_to_any_target_again():
    machine = LoopBench(QUIET)
    # The targets are farther apart than the bound for the output of a stopped axis.
    for target in (5e-6, 55e-6):
        machine.driver.stop()
        machine.run(0.05)
        machine.driver.move_to({"zn": target})
        assert machine.run(0.5)[3][-1] == pytest.approx(target, abs=50e-9)


def test_preparing_an_inverse_does_not_block_a_stop(monkeypatch):
    machine, lock_states = LoopBench(QUIET, is_closed=False), []

    def find_rest_and_record_lock(*arguments):
        lock_states.append(machine.driver.gate._lock.locked())
        return find_rest(*arguments)

    monkeypatch.setattr(axis_inverses, "find_rest", find_rest_and_record_lock)
    machine.driver.compensate("zn", MODEL)
    assert lock_states == [False]
    assert list(machine.driver.compensated_axes) == ["zn"]
