"""What a device must do to be taken for one that streams: silence is then a fault."""

import pytest

from rotemina.drivers.inputs.device import InputReading
from rotemina.drivers.inputs.hid.streaming import GAP_S, SILENCE_S, STEADY_S, Streaming

STICK = b"/dev/hidraw0"


def heard(times, axes=lambda _: (0.0,)):
    streaming = Streaming()
    for time_s in times:
        streaming.receive(InputReading(time_s, axes(time_s), (False,)))
    return streaming


def steadily(seconds, period_s=0.01):
    return [period_s * number for number in range(round(seconds / period_s) + 1)]


def test_one_that_says_the_same_on_and_on_streams():
    assert heard(steadily(STEADY_S + 0.1)).found
    assert not heard(steadily(STEADY_S - 0.1)).found


def test_one_that_says_only_what_has_changed_may_say_it_as_often_as_it_likes():
    assert not heard(steadily(60.0), lambda time_s: (time_s % 1.0,)).found


def test_one_that_repeats_itself_seldom_is_none():
    assert not heard(steadily(60.0, 2 * GAP_S)).found


def test_after_a_silence_it_has_to_be_found_out_anew():
    streaming = heard(steadily(STEADY_S + 0.1))
    again_s = STEADY_S + 0.1 + SILENCE_S + 0.01
    streaming.receive(InputReading(again_s, (0.0,), (False,)))
    assert not streaming.found
    for late_s in steadily(STEADY_S + 0.1):
        streaming.receive(InputReading(again_s + late_s, (0.0,), (False,)))
    assert streaming.found


def test_a_short_pause_is_no_silence():
    streaming = heard(steadily(STEADY_S + 0.1))
    streaming.receive(InputReading(STEADY_S + 0.1 + 0.9 * SILENCE_S, (0.5,), (False,)))
    assert streaming.found


@pytest.mark.parametrize("steady", [True, False])
def test_an_open_joystick_is_watched(hid, hidapi, descriptors, clock, steady):
    plugged = hidapi.plug(STICK, descriptors["list"])
    device = hid.open(hid.devices()[0])
    assert not device.streams
    for number in range(600):
        clock.advance(0.01)
        x = 0 if steady else number % 100
        plugged.waiting.append(bytes([1, 0, 0, x, 0, 0]))
        assert len(device.read()) == 1
    assert device.streams is steady
