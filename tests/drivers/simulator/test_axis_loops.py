"""A loop on the simulated machine: the simulated loop's own samples, and no jump anywhere."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.drivers.clock import VirtualClock
from rotemina.drivers.errors import LimitError, StateError
from rotemina.drivers.profile import Profile, ProfileSegment
from rotemina.drivers.samples import DeviceState
from rotemina.drivers.simulator import axis_inverses
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.compensate.inverse import resting_at
from rotemina.sim.compensate.inverse_parameters import InverseModel
from rotemina.sim.feedback import regulated_plant
from rotemina.sim.feedback.axis_loop import AxisLoop
from rotemina.sim.feedback.feed_forward import FeedForward
from rotemina.sim.feedback.gains import Gains, Notch
from rotemina.sim.feedback.reference_lead import lead_taps
from rotemina.sim.feedback.regulation import Regulation
from rotemina.sim.feedback.stability import UnstableError
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect

RATE_HZ, ZN = 5000.0, 5
GAINS = Gains(
    proportional=0.07,
    integral=1100.0,
    double_integral=300e3,
    derivative=1.7e-4,
    derivative_filter_s=4e-5,
    low_pass_hz=2000.0,
    notch=Notch(420.0, 0.8, 0.03),
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


class Machine:
    """A simulator on a clock set by hand, read every 20 ms."""

    def __init__(self, robot=NOISY, **settings):
        self.clock = VirtualClock(3.0)
        self.driver = Simulator(robot, settings, clock=self.clock)
        self.driver.open()
        self.loop = Regulation(robot, "zn", GAINS, RATE_HZ)
        self.seen = []
        self.run(0.1)

    def run(self, time_s):
        """Go on and return time, command, voltage and reading (n,) of nano Z."""
        parts = []
        for _ in range(max(round(time_s / 0.02), 1)):
            self.clock.advance(0.02)
            parts.append(self.driver.read())
        self.seen += parts
        return tuple(
            np.concatenate([column(one) for one in parts])
            for column in (
                lambda one: one.device_time_s,
                lambda one: one.command[:, ZN],
                lambda one: one.inputs[:, ZN] * AXIS.gain,
                lambda one: one.measured[:, ZN],
            )
        )

    def close_loop(self):
        self.driver.regulate("zn", self.loop)
        assert list(self.driver.regulated) == ["zn"]


def trajectory(path, interval_s=1e-3):
    time_s = interval_s * np.arange(len(path))
    return Record.from_signals(time_s, {("zn", Tap.CMD): path}, {"zn": "m"})


def there_and_back(sample_rate_hz):
    """Close the loop, move, and move elsewhere in mid-move; return all (n,) since it was closed."""
    machine = Machine(QUIET, sample_rate_hz=sample_rate_hz)
    machine.close_loop()
    parts = [machine.run(0.02)]
    machine.driver.move_to({"zn": 47e-6})
    machine.clock.advance(0.002)
    machine.driver.move_to({"zn": 20e-6})
    return tuple(np.concatenate(one) for one in zip(*parts, machine.run(0.1), strict=True))


def test_the_live_trace_is_that_of_the_simulated_loop_sample_for_sample():
    _, reference, sent, read = there_and_back(5000.0)
    feed = FeedForward(lead_taps(AXIS, 1.0 / RATE_HZ))
    traces = AxisLoop(QUIET, "zn", RATE_HZ).follow(GAINS, reference, feed_forward=feed)
    np.testing.assert_allclose(read, traces.reading, rtol=0.0, atol=1e-14)
    np.testing.assert_allclose(sent, traces.output, rtol=0.0, atol=1e-14)
    assert np.ptp(sent - reference) > 1e-6  # the loop has something to do


def test_a_machine_that_samples_more_slowly_runs_the_very_same_loop():
    fine, coarse = there_and_back(5000.0), there_and_back(1000.0)
    np.testing.assert_allclose(np.diff(coarse[0]), 1e-3, rtol=1e-6)
    same = [int(np.argmin(np.abs(fine[0] - time_s))) for time_s in coarse[0]]
    for one, other in zip(fine, coarse, strict=True):
        np.testing.assert_allclose(one[same], other, rtol=0.0, atol=1e-13)


def test_nothing_jumps_when_it_is_put_on_taken_off_or_reset():
    machine = Machine()
    machine.driver.move_to({"zn": 45e-6})
    _, _, before, stands = machine.run(0.5)
    machine.close_loop()
    _, command, sent, read = machine.run(0.1)
    noise = 5 * AXIS.sensor.noise_rms + AXIS.sensor.resolution
    assert command[-1] == stands[-1]
    assert abs(command[-1] - 45e-6) > 1e-6  # hysteresis: it was never where it was told to be
    assert np.abs(sent - before[-1]).max() < 4 * noise
    assert np.abs(read - stands[-1]).max() < 2 * noise
    machine.driver.move_to({"zn": 30e-6})
    held = machine.run(0.5)[2][-1]
    machine.driver.regulate("zn", None)
    assert machine.driver.regulated == {}
    time_s, command, sent, _ = machine.run(0.1)
    assert np.abs(sent - held).max() < 2 * noise
    assert np.ptp(sent) == 0.0
    np.testing.assert_allclose(command, sent, rtol=0.0, atol=1e-18)
    np.testing.assert_allclose(np.diff(time_s), 1e-3, rtol=1e-6)


def test_a_stop_in_motion_halts_the_axis_under_its_loop():
    machine = Machine()
    machine.close_loop()
    machine.driver.move_to({"zn": 60e-6})
    machine.clock.advance(0.003)
    machine.driver.stop()
    _, command, sent, read = machine.run(0.2)
    assert machine.driver.status().state is DeviceState.IDLE
    assert 33e-6 < command[-1] < 59e-6
    assert np.abs(np.diff(command)).max() <= AXIS.max_speed * 1e-3 * (1 + 1e-9)
    assert abs(read[-50:].mean() - command[-1]) < 10e-9
    assert np.abs(np.diff(sent)).max() < 6e-6  # no leap of the amplifier
    assert list(machine.driver.regulated) == ["zn"]


def test_a_stop_in_a_trajectory_halts_it_from_the_speed_that_it_has():
    machine = Machine()
    machine.close_loop()
    path = 32e-6 + 20e-6 * np.sin(2 * np.pi * 5.0 * 1e-3 * np.arange(2000))
    machine.driver.play(trajectory(path))
    machine.run(0.8)
    assert machine.driver.status().state is DeviceState.PLAYING
    machine.driver.stop()
    _, command, _, _ = machine.run(0.2)
    steps = np.diff(np.concatenate([machine.seen[-51].command[-2:, ZN], command]))
    assert np.abs(np.diff(steps)).max() <= AXIS.max_acceleration * 1e-6 * 1.01
    assert machine.driver.status().state is DeviceState.IDLE


def test_outputs_keep_the_range_and_what_is_beyond_is_said():
    machine = Machine()
    machine.close_loop()
    machine.driver.move_to({"zn": 60e-6})
    machine.run(0.4)
    machine.driver.move_to({"zn": 0.0})  # with hysteresis it takes less than there is
    _, _, sent, _ = machine.run(0.6)
    assert sent.min() == 0.0
    assert machine.driver.regulation_limited == ("zn",)
    machine.driver.move_to({"zn": 40e-6})
    _, command, _, read = machine.run(0.4)
    assert abs(read[-50:].mean() - command[-1]) < 10e-9  # nothing has wound up
    assert machine.driver.regulation_limited == ()
    with pytest.raises(LimitError, match="outside its range"):
        machine.driver.move_to({"zn": 66e-6})
    with pytest.raises(LimitError, match=r"the loop of axis .* sets its voltage"):
        machine.driver.set_voltage("zn", 50.0)


def test_rows_are_followed_smoothly_and_named():
    machine = Machine()
    machine.close_loop()
    path = 32e-6 + 20e-6 * np.sin(2 * np.pi * 10.0 * 1e-3 * np.arange(400))
    machine.driver.play(trajectory(path))
    machine.run(1.2)
    rows = np.concatenate([one.playback_row for one in machine.seen])
    command, read = (
        np.concatenate([getattr(one, name)[:, ZN] for one in machine.seen])
        for name in ("command", "measured")
    )
    named = rows >= 0
    assert rows[named].tolist() == list(range(400))
    np.testing.assert_allclose(command[named], path, rtol=0.0, atol=1e-18)
    error = (read[named] - path)[100:]
    assert np.sqrt(np.mean(error**2)) < 1e-3 * AXIS.span  # of it 12 nm are noise
    assert machine.driver.status().state is DeviceState.IDLE


def test_a_profile_runs_at_its_own_pace_and_one_from_before_is_forgotten():
    machine = Machine()
    profile = Profile("zn", (ProfileSegment(0.1, 0.0, 6e-6, -4e-6),))
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


def test_an_inverse_goes_over_into_the_loop_and_back():
    machine = Machine()
    machine.driver.compensate("zn", MODEL)
    before = machine.run(0.02)[2][-1]
    machine.close_loop()
    _, command, sent, read = machine.run(0.1)
    assert np.abs(sent - before).max() < 0.3e-6
    assert abs(read[-50:].mean() - command[-1]) < 10e-9
    machine.driver.compensate("zn", None)
    machine.driver.compensate("zn", MODEL)
    _, same, again, _ = machine.run(0.1)
    assert np.abs(again - sent[-1]).max() < 0.3e-6
    assert same[-1] == command[-1]
    assert set(machine.driver.compensated) == {"zn"}
    machine.driver.move_to({"zn": 50e-6})
    held = machine.run(0.3)[2][-1]
    machine.driver.regulate("zn", None)
    _, _, sent, _ = machine.run(0.05)
    assert sent[-1] == pytest.approx(held, abs=1e-7)
    assert set(machine.driver.compensated) == {"zn"}


def test_a_new_connection_ends_it_with_the_output_as_it_was():
    machine = Machine()
    machine.close_loop()
    machine.driver.move_to({"zn": 50e-6})
    held = machine.run(0.3)[2][-1]
    machine.driver.close()
    assert machine.driver.regulated == {}
    machine.driver.open()
    machine.run(0.05)
    sent = machine.seen[-1].inputs[-1, ZN] * AXIS.gain
    assert sent == pytest.approx(held, abs=1e-7)


def test_what_may_not_be_applied_is_refused_with_the_reason():
    with pytest.raises(UnstableError, match="unstable, its largest pole"):
        Regulation(NOISY, "zn", replace(GAINS, integral=6000.0), RATE_HZ)
    # Stable as the axis is, and too near the end where it is off by 5 %.
    lively = replace(GAINS, integral=1300.0)
    Regulation(NOISY, "zn", lively, RATE_HZ, spread=0.0)
    with pytest.raises(UnstableError, match=r"Ms = .* \(with gain or resonance off by 5 %"):
        Regulation(NOISY, "zn", lively, RATE_HZ)
    machine = Machine()
    with pytest.raises(LimitError, match="at 5000 Hz: the simulated machine samples at 3000 Hz"):
        Machine(NOISY, sample_rate_hz=3000.0).close_loop()
    with pytest.raises(LimitError, match="the loop is for axis zn, not for thx"):
        machine.driver.regulate("thx", machine.loop)
    machine.driver.move_to({"zn": 40e-6})
    with pytest.raises(StateError, match="while it is moving"):
        machine.driver.regulate("zn", machine.loop)
    machine.run(0.2)
    other = replace(NOISY, axes={**NOISY.axes, "zn": replace(AXIS, max_speed=1e-3)})
    with pytest.raises(LimitError, match="was found stable on robot"):
        machine.driver.regulate("zn", Regulation(other, "zn", GAINS, RATE_HZ))
    assert machine.driver.regulated == {}


@pytest.mark.parametrize("slow", [False, True])
def test_a_loop_that_nothing_answers_is_given_up_and_its_output_stays(slow, monkeypatch):
    machine = Machine()
    machine.close_loop()
    before = machine.run(0.1)[2][-1]
    late = (AxisEffect(axis="zn", id="delay", parameters={"delay": 1e-3}),) if slow else ()
    machine.driver.set_effects((*WORN, *late))
    monkeypatch.setattr(regulated_plant, "_LOST", 1e-6)  # less than the noise is far off then
    machine.driver.move_to({"zn": 33.0017e-6})  # between two steps of the sensor
    machine.run(0.1)
    status = machine.driver.status()
    assert status.state is DeviceState.FAULT
    assert "axis zn: its loop was opened because the axis does not respond" in status.fault
    machine.driver.clear_fault()
    assert machine.driver.regulated == {}
    sent = machine.run(0.1)[2]
    assert sent[-1] == pytest.approx(before, abs=1.5e-6)
    assert np.ptp(sent) < 1e-15


def test_a_delay_that_comes_while_it_runs_is_simulated_too():
    machine = Machine()
    machine.close_loop()
    delay = AxisEffect(axis="zn", id="delay", parameters={"delay": 3e-4})
    machine.driver.set_effects((*WORN, delay))
    machine.driver.move_to({"zn": 45e-6})
    _, command, sent, read = machine.run(0.3)
    assert abs(read[-50:].mean() - command[-1]) < 20e-9
    assert sent.max() <= AXIS.range[1]


def test_a_loop_that_holds_a_stopped_axis_leads_its_output_no_farther_than_the_bound():
    machine = Machine(QUIET)
    machine.close_loop()
    machine.driver.stop()
    machine.run(0.1)
    (controller,) = machine.driver._running._regulating._controllers.values()
    held = controller.output
    most = 0.35 * AXIS.span
    astray = [controller.answer(held, held - 0.9 * most) for _ in range(500)]  # a wrong sensor
    assert max(astray) == pytest.approx(held + most)


def test_a_loop_that_holds_a_stopped_axis_does_not_answer_a_reading_out_of_bounds(monkeypatch):
    monkeypatch.setattr(regulated_plant, "_watch", lambda *_: None)  # which gives such a loop up
    machine = Machine(QUIET)
    machine.close_loop()
    machine.driver.stop()
    machine.run(0.1)
    device = machine.driver._running
    (controller,) = device._regulating._controllers.values()
    reference, held = float(device.command[ZN]), controller.output
    for wrong in (1.1 * 0.35 * AXIS.span, -AXIS.span, float("nan")):
        assert {controller.answer(reference, reference + wrong) for _ in range(50)} == {held}
    # The compiled loop does as the sampled one, here with a reference that is too far off.
    elsewhere = np.array([*device.command[:ZN], reference + 0.4 * AXIS.span])
    device._setpoints.take_over(elsewhere, np.zeros(ZN + 1))
    device.advance(device.time_s + 0.004)
    assert device.command[ZN] == elsewhere[ZN]
    assert device.sent[ZN] == held


def test_a_stopped_axis_goes_anywhere_again_when_it_is_told_to():
    machine = Machine(QUIET)
    machine.close_loop()
    for target in (5e-6, 55e-6):  # farther apart than a held output may go
        machine.driver.stop()
        machine.run(0.05)
        machine.driver.move_to({"zn": target})
        assert machine.run(0.5)[3][-1] == pytest.approx(target, abs=50e-9)


def test_an_inverse_is_prepared_while_a_stop_can_pass_the_gate(monkeypatch):
    machine, held = Machine(QUIET), []

    def resting(*given):
        held.append(machine.driver.gate._lock.locked())
        return resting_at(*given)

    monkeypatch.setattr(axis_inverses, "resting_at", resting)
    machine.driver.compensate("zn", MODEL)
    assert held == [False]
    assert list(machine.driver.compensated) == ["zn"]
