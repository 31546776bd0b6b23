"""What a device said acts only for as long as the device confirms it."""

from math import nan

import numpy as np
import pytest

from rotemina.app.motion.teleoperation.input_arbiter import InputArbiter
from rotemina.app.motion.teleoperation.intent import Action
from rotemina.app.motion.teleoperation.profile import (
    ActionMapping,
    AxisMapping,
    DeviceMapping,
    OperatorRole,
    Profile,
    SilencePolicy,
)
from rotemina.app.motion.teleoperation.profile_check import PluggedDevice
from rotemina.app.motion.teleoperation.report_watch import (
    MAX_PAUSE_S,
    MAX_SILENCE_S,
    MAX_STILLNESS_S,
    check_reading,
)
from rotemina.drivers.inputs.device import InputIdentity, InputReading

STEP_S = 0.005
BUTTONS = ("dead", "coarse", "stop", "stage")
ACTIONS = (Action.DEAD_MAN, Action.COARSE, Action.STOP, Action.STAGE)


def plugged(key="stick"):
    return PluggedDevice(InputIdentity(key, key, "test"), ("X", "Y"), BUTTONS)


def mapping(key="stick", policy=SilencePolicy.STOP, axes=("x", "y"), buttons=BUTTONS):
    return DeviceMapping(
        key=key,
        when_silent=policy,
        axes=tuple(
            AxisMapping(control=control, drives=axis)
            for control, axis in zip("XY", axes, strict=False)
        ),
        actions=tuple(
            ActionMapping(control=button, action=action)
            for button, action in zip(BUTTONS, ACTIONS, strict=True)
            if button in buttons
        ),
    )


class Hands:
    """Devices that say something only when a test lets them."""

    def __init__(self, *mappings):
        mappings = mappings or (mapping(),)
        self.arbiter = InputArbiter(("x", "y"), Profile(name="Test", devices=mappings))
        self.now_s = 100.0
        self.waiting = {}
        self.lost = []
        self.pressed = []
        self.intent = None
        for each in mappings:
            self.arbiter.plug(plugged(each.key))
            self.say(each.key)
        self.run(0.3)

    def say(self, key="stick", x=0.0, held=(), y=0.0):
        buttons = tuple(button in held for button in BUTTONS)
        reading = InputReading(self.now_s, (x, y), buttons)
        self.waiting.setdefault(key, []).append(reading)

    def step(self, after_s=STEP_S):
        self.now_s += after_s
        waiting, self.waiting = self.waiting, {}
        self.intent = self.arbiter.step(waiting, self.now_s)
        self.lost += [self.intent.lost] if self.intent.lost is not None else []
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

    def drive(self, held=("dead",)):
        """Deflect the stick, each change told once."""
        self.say(held=held)
        self.run(0.1)
        self.say(x=0.8, held=held)
        self.run(0.1)
        assert self.x > 0.7

    def moves_for_s(self, limit_s=5.0):
        """Return for how long it goes on without a word."""
        began_s = self.now_s
        while self.x and self.now_s - began_s < limit_s:
            self.step()
        return self.now_s - began_s


# A device that reports only changes


def test_held_still_it_counts_as_released_after_a_second_and_says_what_to_do():
    hands = Hands()
    hands.drive()
    assert hands.moves_for_s() == pytest.approx(MAX_STILLNESS_S - 0.1, abs=0.03)
    assert hands.intent.held == frozenset()
    [why] = hands.lost
    assert why.startswith("stick: silent for 1 s while it moved something")
    assert "move the stick a little" in why
    assert "choose under Set up, Mapping" in why
    assert why.endswith(hands.arbiter.views[0].problem)


def test_any_report_within_the_second_renews_it():
    hands = Hands()
    hands.drive()
    for number in range(10):
        hands.run(0.9)
        assert hands.x > 0.7
        hands.say(x=0.8 + 0.004 * (number % 2), held=("dead",))
    assert hands.lost == []


def test_back_from_silence_it_wants_the_centre_and_the_dead_man_anew():
    hands = Hands()
    hands.drive()
    hands.run(2.0)
    hands.say(x=0.7, held=("dead",))
    hands.run(0.3)
    assert (hands.x, hands.intent.held) == (0.0, frozenset())
    hands.say(held=("dead",))
    hands.run(0.3)
    hands.say(x=0.7, held=("dead",))
    hands.run(0.1)
    assert hands.x == 0.0  # the dead-man was never released
    hands.say()
    hands.run(0.3)
    hands.drive()


def test_at_rest_it_may_be_silent_with_the_dead_man_held():
    hands = Hands()
    hands.say(held=("dead",))
    hands.run(60.0)
    hands.say(x=0.8, held=("dead",))
    hands.run(0.1)
    assert hands.x > 0.7
    assert hands.lost == []


@pytest.mark.parametrize("button", ["dead", "coarse"])
def test_a_pedal_that_holds_what_matters_must_confirm_it_too(button):
    stick = mapping(buttons=() if button == "dead" else ("dead",))
    hands = Hands(stick, mapping("pedal", axes=(), buttons=(button,)))
    hands.say("pedal", held=(button,))
    values = iter(0.8 + 0.0001 * number for number in range(1000))
    hands.say(held=("dead",))
    hands.run(0.5)
    hands.run(0.4, lambda: hands.say(x=next(values), held=("dead",)))
    assert hands.x > 0.7
    hands.run(0.4, lambda: hands.say(x=next(values), held=("dead",)))
    assert hands.x == 0.0
    [why] = hands.lost
    assert why.startswith("pedal: silent for 1 s")


def test_an_operator_may_choose_that_it_continues():
    hands = Hands(mapping(policy=SilencePolicy.CONTINUE))
    hands.drive()
    assert hands.moves_for_s(30.0) > 29.9
    assert hands.lost == []


# A device that keeps reporting


def noise(levels, seed=1):
    rng = np.random.default_rng(seed)
    return lambda: float(rng.integers(-levels, levels, endpoint=True)) / 127.5


@pytest.mark.parametrize("levels", [0, 1, 2, 9])
def test_a_stream_that_breaks_off_counts_as_released_whatever_its_noise(levels):
    hands, small = Hands(), noise(levels)
    hands.run(3.0, lambda: hands.say(x=small(), y=small()))
    hands.run(0.2, lambda: hands.say(x=small(), y=small(), held=("dead",)))
    hands.run(0.5, lambda: hands.say(x=0.8 + small(), y=small(), held=("dead",)))
    assert hands.x > 0.6
    assert hands.moves_for_s() <= 0.3
    assert hands.intent.held == frozenset()
    [why] = hands.lost
    assert "a streaming device has sent nothing for 0.25 s" in why
    hands.run(0.5, lambda: hands.say(x=0.8 + small(), y=small(), held=("dead",)))
    assert (hands.x, hands.intent.held) == (0.0, frozenset())


def test_a_stream_that_breaks_off_at_its_centre_loses_the_dead_man_too():
    hands = Hands()
    hands.run(0.3, hands.say)
    hands.run(0.2, lambda: hands.say(held=("dead",)))
    hands.run(0.3)
    assert hands.intent.held == frozenset()
    hands.run(0.3, lambda: hands.say(x=0.8, held=("dead",)))
    assert hands.x == 0.0


def test_after_an_interruption_a_stream_is_recognized_again():
    hands = Hands()
    for _ in range(3):
        hands.run(0.3, hands.say)
        hands.run(0.2, lambda: hands.say(held=("dead",)))
        hands.run(0.3, lambda: hands.say(x=0.8, held=("dead",)))
        assert hands.moves_for_s() <= 0.3
    assert len(hands.lost) == 3


def test_noise_that_repeats_itself_is_a_stream_even_if_the_operator_chose_to_continue():
    hands, small = Hands(mapping(policy=SilencePolicy.CONTINUE)), noise(1)
    hands.run(0.5, lambda: hands.say(x=small()))
    hands.run(0.1, lambda: hands.say(held=("dead",)))
    hands.run(0.5, lambda: hands.say(x=0.8 + small(), held=("dead",)))
    assert hands.x > 0.6
    assert hands.moves_for_s() <= 0.3


def test_a_hand_that_moves_a_stick_for_long_does_not_make_it_a_stream():
    hands = Hands(mapping(policy=SilencePolicy.CONTINUE))
    hands.say(held=("dead",))
    values = iter(0.2 + 0.0001 * number for number in range(4000))
    hands.run(10.0, lambda: hands.say(x=next(values), held=("dead",)))
    assert hands.moves_for_s(20.0) > 19.9


def test_one_that_streams_only_while_it_is_deflected_may_be_silent_at_rest():
    hands = Hands()
    hands.say(held=("dead",))
    hands.run(1.0, lambda: hands.say(x=1.0, held=("dead",)))
    hands.say()
    hands.run(10.0)
    assert hands.lost == []
    hands.drive()


# Reports that cannot be understood


@pytest.mark.parametrize(
    "answer",
    [
        InputReading(100.0, (nan, nan), (False,) * 4, "a report of type 9"),
        InputReading(100.0, (0.8,), (True,) * 4),
        InputReading(100.0, (0.8, None), (True,) * 4),
        InputReading(None, (0.8, 0.0), (True,) * 4),
        InputReading(100.0, None, None),
        "nonsense",
        None,
    ],
)
def test_what_is_no_sound_reading_counts_as_released_and_is_counted(answer):
    hands = Hands()
    hands.drive()
    hands.waiting["stick"] = [answer]
    hands.step()
    assert (hands.x, hands.intent.held) == (0.0, frozenset())
    assert len(hands.lost) == 1
    [view] = hands.arbiter.views
    assert view.faults == 1
    assert view.fault in hands.lost[0]
    assert view.newest is None
    [received] = hands.arbiter.received["stick"]
    assert (len(received.axes), len(received.buttons)) == (2, 4)
    hands.say(x=0.8, held=("dead",))
    hands.run(0.3)
    assert (hands.x, hands.intent.held) == (0.0, frozenset())
    hands.say()
    hands.run(0.3)
    hands.drive()
    assert hands.arbiter.views[0].faults == 1


@pytest.mark.parametrize("raw", [1.5, -7.0, nan, float("inf")])
def test_a_deflection_beyond_the_range_moves_nothing_until_the_centre_was_seen(raw):
    hands = Hands()
    hands.drive()
    hands.say(x=raw, held=("dead",))
    hands.step()
    assert hands.x == 0.0
    hands.say(x=0.8, held=("dead",))
    hands.run(0.3)
    assert hands.x == 0.0


# Clocks


@pytest.mark.parametrize("jump_s", [MAX_PAUSE_S + 0.01, 60.0, -5.0])
@pytest.mark.parametrize("policy", SilencePolicy)
@pytest.mark.parametrize("backlog", [False, True])
def test_after_a_gap_in_the_programs_clock_nothing_old_acts(jump_s, policy, backlog):
    hands = Hands(mapping(policy=policy))
    hands.drive()
    if backlog:  # what was sent meanwhile, and is read only now
        hands.say(x=0.8, held=("dead", "stage"))
        hands.say(x=0.9, held=("dead",))
    hands.step(jump_s)
    assert (hands.x, hands.intent.held, hands.pressed) == (0.0, frozenset(), [])
    assert "its clock jumped by" in hands.lost[0]
    hands.say(x=0.9, held=("dead",))
    hands.run(0.3)
    assert (hands.x, hands.intent.held) == (0.0, frozenset())
    assert len(hands.lost) == 1
    hands.say()
    hands.run(0.3)
    hands.drive()


def test_a_stop_that_waited_through_a_gap_still_stops():
    hands = Hands()
    hands.say(held=("stop",))
    hands.step(60.0)
    assert Action.STOP in hands.pressed


def test_a_device_at_rest_stays_usable_after_a_gap():
    hands = Hands()
    hands.step(60.0)
    hands.drive()
    assert hands.lost == []


@pytest.mark.parametrize("wrong_s", [-1e9, 1e9, nan, float("inf")])
def test_a_source_with_another_clock_gains_no_consent_by_it(wrong_s):
    hands = Hands()
    hands.drive()
    buttons = (True, False, False, False)
    hands.waiting["stick"] = [InputReading(wrong_s, (0.81, 0.0), buttons)]
    hands.step()
    assert hands.moves_for_s() <= MAX_STILLNESS_S + 0.02


def test_the_time_of_a_reading_lies_between_the_looks():
    buttons = (False,) * 4
    times_s = [
        check_reading(plugged(), InputReading(time_s, (0.0, 0.0), buttons), 1.0, 2.0).host_time_s
        for time_s in (0.0, 1.5, 9.0, nan, float("inf"))
    ]
    assert times_s[:3] == [1.0, 1.5, 2.0]
    assert all(1.0 <= time_s <= 2.0 for time_s in times_s)


def test_the_bounds_fit_together():
    assert MAX_SILENCE_S + 2 * STEP_S <= 0.3
    assert MAX_SILENCE_S < MAX_PAUSE_S < MAX_STILLNESS_S


def test_a_device_that_only_watches_does_not_stop_the_one_that_drives():
    trainee = DeviceMapping(
        key="trainee",
        seat=OperatorRole.TRAINEE,
        axes=(AxisMapping(control="X", drives="x"),),
    )
    hands = Hands(mapping(), trainee)
    hands.say("trainee", x=0.9)
    values = iter(0.8 + 0.0001 * number for number in range(1000))
    hands.say(held=("dead",))
    hands.run(2.0, lambda: hands.say(x=next(values), held=("dead",)))
    assert hands.x > 0.7
    assert hands.lost == []
