"""A report of an input device acts only for as long as the device confirms it."""

from itertools import count
from math import nan

import numpy as np
import pytest

from rotemina.app.motion.inputs import (
    ActionMapping,
    AxisMapping,
    DeviceMapping,
    InputArbiter,
    InputProfile,
    OperatorAction,
    OperatorRole,
    PluggedDevice,
    SilencePolicy,
)
from rotemina.app.motion.inputs.report_watch import MAX_PAUSE_S, MAX_STILLNESS_S
from rotemina.drivers.inputs import InputIdentity, InputReading

STEP_S = 0.005
ACTIONS = {
    "dead": OperatorAction.DEAD_MAN,
    "coarse": OperatorAction.COARSE,
    "stop": OperatorAction.STOP,
    "stage": OperatorAction.STAGE,
}
BUTTONS = tuple(ACTIONS)


def make_device(key="stick"):
    return PluggedDevice(InputIdentity(key, key, "test"), ("X", "Y"), BUTTONS)


def make_mapping(key="stick", policy=SilencePolicy.STOP, axes=("x", "y"), buttons=BUTTONS):
    return DeviceMapping(
        key=key,
        when_silent=policy,
        axes=tuple(
            AxisMapping(control=control, drives=axis)
            for control, axis in zip("XY", axes, strict=False)
        ),
        actions=tuple(
            ActionMapping(control=button, action=action)
            for button, action in ACTIONS.items()
            if button in buttons
        ),
    )


class ReportingDevices:
    """Input devices that report only when a test tells them to."""

    def __init__(self, *mappings):
        mappings = mappings or (make_mapping(),)
        self.arbiter = InputArbiter(("x", "y"), InputProfile(name="Test", devices=mappings))
        self.now_s = 100.0
        self.waiting = {}
        self.losses = []
        self.pressed = []
        self.intent = None
        for device_mapping in mappings:
            self.arbiter.plug(make_device(device_mapping.key))
            self.report(device_mapping.key)
        self.run(0.3)

    def report(self, key="stick", x=0.0, held=(), y=0.0):
        buttons = tuple(button in held for button in BUTTONS)
        reading = InputReading(self.now_s, (x, y), buttons)
        self.waiting.setdefault(key, []).append(reading)

    def step(self, after_s=STEP_S):
        self.now_s += after_s
        waiting, self.waiting = self.waiting, {}
        self.intent = self.arbiter.step(waiting, self.now_s)
        self.losses += [self.intent.loss_reason] if self.intent.loss_reason is not None else []
        self.pressed += sorted(self.intent.pressed)
        return self.intent

    def run(self, seconds, stream=None):
        for _ in range(round(seconds / STEP_S)):
            if stream is not None:
                stream()
            self.step()
        return self.intent

    @property
    def x(self):
        return self.intent.deflections.get("x", 0.0)

    def stream(self, seconds, read_x=lambda: 0.0, read_y=lambda: 0.0, held=("dead",)):
        """Report in every step."""
        return self.run(seconds, lambda: self.report(x=read_x(), y=read_y(), held=held))

    def drive(self, held=("dead",)):
        """Deflect the stick, and report each change once."""
        self.report(held=held)
        self.run(0.1)
        self.report(x=0.8, held=held)
        self.run(0.1)
        assert self.x > 0.7

    def measure_motion_s(self, limit_s=5.0):
        """Return for how long, s, the motion continues without a report."""
        began_s = self.now_s
        while self.x and self.now_s - began_s < limit_s:
            self.step()
        return self.now_s - began_s


# A device that reports only changes


def test_a_stick_held_still_counts_as_released_after_a_second_and_gives_advice():
    devices = ReportingDevices()
    devices.drive()
    assert devices.measure_motion_s() == pytest.approx(MAX_STILLNESS_S - 0.1, abs=0.03)
    assert devices.intent.held == frozenset()
    [reason] = devices.losses
    assert reason.startswith("stick: silent for 1 s while it moved something")
    assert "move the stick a little" in reason
    assert "choose under Set up, Mapping" in reason
    assert reason.endswith(devices.arbiter.device_views[0].problem)


def test_any_report_within_a_second_confirms_the_deflection():
    devices = ReportingDevices()
    devices.drive()
    for number in range(10):
        devices.run(0.9)
        assert devices.x > 0.7
        devices.report(x=0.8 + 0.004 * (number % 2), held=("dead",))
    assert devices.losses == []


def test_after_silence_stick_and_dead_man_switch_must_be_released_first():
    devices = ReportingDevices()
    devices.drive()
    devices.run(2.0)
    devices.report(x=0.7, held=("dead",))
    devices.run(0.3)
    assert (devices.x, devices.intent.held) == (0.0, frozenset())
    devices.report(held=("dead",))
    devices.run(0.3)
    devices.report(x=0.7, held=("dead",))
    devices.run(0.1)
    assert devices.x == 0.0  # the dead-man was never released
    devices.report()
    devices.run(0.3)
    devices.drive()


def test_a_stick_at_rest_may_be_silent_with_the_dead_man_switch_held():
    devices = ReportingDevices()
    devices.report(held=("dead",))
    devices.run(60.0)
    devices.report(x=0.8, held=("dead",))
    devices.run(0.1)
    assert devices.x > 0.7
    assert devices.losses == []


@pytest.mark.parametrize("button", ["dead", "coarse"])
def test_a_pedal_with_an_active_button_must_confirm_it_too(button):
    stick = make_mapping(buttons=() if button == "dead" else ("dead",))
    devices = ReportingDevices(stick, make_mapping("pedal", axes=(), buttons=(button,)))
    devices.report("pedal", held=(button,))
    devices.report(held=("dead",))
    devices.run(0.5)
    read_x = make_slow_motion(0.8)
    devices.stream(0.4, read_x)
    assert devices.x > 0.7
    devices.stream(0.4, read_x)
    assert devices.x == 0.0
    [reason] = devices.losses
    assert reason.startswith("pedal: silent for 1 s")


def test_the_operator_can_choose_to_continue_in_silence():
    devices = ReportingDevices(make_mapping(policy=SilencePolicy.CONTINUE))
    devices.drive()
    assert devices.measure_motion_s(30.0) > 29.9
    assert devices.losses == []


# A device that keeps reporting


def make_noise(levels, seed=1):
    rng = np.random.default_rng(seed)
    return lambda: float(rng.integers(-levels, levels, endpoint=True)) / 127.5


def make_slow_motion(begin):
    """Return a function whose results differ each time."""
    return count(begin, 0.0001).__next__


@pytest.mark.parametrize("levels", [0, 9])
def test_an_interrupted_stream_counts_as_released_at_any_noise(levels):
    devices, sample_noise = ReportingDevices(), make_noise(levels)

    def read_deflected_x():
        return 0.8 + sample_noise()

    devices.stream(3.0, sample_noise, sample_noise, held=())
    devices.stream(0.2, sample_noise, sample_noise)
    devices.stream(0.5, read_deflected_x, sample_noise)
    assert devices.x > 0.6
    assert devices.measure_motion_s() <= 0.3
    assert devices.intent.held == frozenset()
    [reason] = devices.losses
    assert "a streaming device has sent nothing for 0.25 s" in reason
    devices.stream(0.5, read_deflected_x, sample_noise)
    assert (devices.x, devices.intent.held) == (0.0, frozenset())


def test_a_stream_interrupted_at_its_centre_releases_the_dead_man_switch():
    devices = ReportingDevices()
    devices.stream(0.3, held=())
    devices.stream(0.2)
    devices.run(0.3)
    assert devices.intent.held == frozenset()
    devices.stream(0.3, lambda: 0.8)
    assert devices.x == 0.0


def test_after_an_interruption_a_stream_is_recognized_again():
    devices = ReportingDevices()
    for _ in range(3):
        devices.stream(0.3, held=())
        devices.stream(0.2)
        devices.stream(0.3, lambda: 0.8)
        assert devices.measure_motion_s() <= 0.3
    assert len(devices.losses) == 3


def test_repeating_noise_is_a_stream_even_if_the_operator_chose_to_continue():
    devices = ReportingDevices(make_mapping(policy=SilencePolicy.CONTINUE))
    sample_noise = make_noise(1)
    devices.stream(0.5, sample_noise, held=())
    devices.stream(0.1)
    devices.stream(0.5, lambda: 0.8 + sample_noise())
    assert devices.x > 0.6
    assert devices.measure_motion_s() <= 0.3


def test_moving_a_stick_for_long_does_not_make_it_a_stream():
    devices = ReportingDevices(make_mapping(policy=SilencePolicy.CONTINUE))
    devices.report(held=("dead",))
    devices.stream(10.0, make_slow_motion(0.2))
    assert devices.measure_motion_s(20.0) > 19.9


def test_a_device_that_streams_only_while_deflected_may_be_silent_at_rest():
    devices = ReportingDevices()
    devices.report(held=("dead",))
    devices.stream(1.0, lambda: 1.0)
    devices.report()
    devices.run(10.0)
    assert devices.losses == []
    devices.drive()


# Reports that cannot be understood


@pytest.mark.parametrize(
    "answer",
    [
        InputReading(100.0, (nan, nan), (False,) * 4, "a report of type 9"),
        InputReading(100.0, (0.8,), (True,) * 4),
        InputReading(None, (0.8, 0.0), (True,) * 4),
        InputReading(100.0, None, None),
        "nonsense",
    ],
)
def test_an_invalid_reading_counts_as_released_and_as_a_fault(answer):
    devices = ReportingDevices()
    devices.drive()
    devices.waiting["stick"] = [answer]
    devices.step()
    assert (devices.x, devices.intent.held) == (0.0, frozenset())
    assert len(devices.losses) == 1
    [view] = devices.arbiter.device_views
    assert view.fault_count == 1
    assert view.fault in devices.losses[0]
    assert view.latest_reading is None
    [received] = devices.arbiter.latest_readings["stick"]
    assert (len(received.axes), len(received.buttons)) == (2, 4)
    devices.report(x=0.8, held=("dead",))
    devices.run(0.3)
    assert (devices.x, devices.intent.held) == (0.0, frozenset())
    devices.report()
    devices.run(0.3)
    devices.drive()
    assert devices.arbiter.device_views[0].fault_count == 1


@pytest.mark.parametrize("raw", [1.5, nan, float("-inf")])
def test_a_deflection_beyond_the_range_moves_nothing_until_the_stick_is_centred(raw):
    devices = ReportingDevices()
    devices.drive()
    devices.report(x=raw, held=("dead",))
    devices.step()
    assert devices.x == 0.0
    devices.report(x=0.8, held=("dead",))
    devices.run(0.3)
    assert devices.x == 0.0


# Clocks


@pytest.mark.parametrize("jump_s", [MAX_PAUSE_S + 0.01, -5.0])
@pytest.mark.parametrize("policy", SilencePolicy)
def test_after_a_gap_in_the_programs_clock_old_reports_do_not_act(jump_s, policy):
    devices = ReportingDevices(make_mapping(policy=policy))
    devices.drive()
    # Reports sent during the gap and read only now.
    devices.report(x=0.8, held=("dead", "stage"))
    devices.report(x=0.9, held=("dead",))
    devices.step(jump_s)
    assert (devices.x, devices.intent.held, devices.pressed) == (0.0, frozenset(), [])
    assert "its clock jumped by" in devices.losses[0]
    devices.report(x=0.9, held=("dead",))
    devices.run(0.3)
    assert (devices.x, devices.intent.held) == (0.0, frozenset())
    assert len(devices.losses) == 1
    devices.report()
    devices.run(0.3)
    devices.drive()


def test_a_stop_from_before_a_gap_still_stops():
    devices = ReportingDevices()
    devices.report(held=("stop",))
    devices.step(60.0)
    assert OperatorAction.STOP in devices.pressed


def test_a_device_at_rest_stays_usable_after_a_gap():
    devices = ReportingDevices()
    devices.step(60.0)
    devices.drive()
    assert devices.losses == []


@pytest.mark.parametrize("wrong_s", [-1e9, 1e9, nan, float("inf")])
def test_a_wrong_source_clock_does_not_prolong_consent(wrong_s):
    devices = ReportingDevices()
    devices.drive()
    buttons = (True, False, False, False)
    devices.waiting["stick"] = [InputReading(wrong_s, (0.81, 0.0), buttons)]
    devices.step()
    assert devices.measure_motion_s() <= MAX_STILLNESS_S + 0.02


def test_a_watching_device_does_not_stop_the_driving_one():
    trainee = DeviceMapping(
        key="trainee",
        seat=OperatorRole.TRAINEE,
        axes=(AxisMapping(control="X", drives="x"),),
    )
    devices = ReportingDevices(make_mapping(), trainee)
    devices.report("trainee", x=0.9)
    devices.report(held=("dead",))
    devices.stream(2.0, make_slow_motion(0.8))
    assert devices.x > 0.7
    assert devices.losses == []
