"""The check of input devices finds each thing that a source can do wrong."""

import pytest

from rotemina.app.plugin_kit.input_check import check_inputs
from rotemina.drivers.errors import StateError
from rotemina.drivers.inputs.device import (
    InputDevice,
    InputIdentity,
    InputLostError,
    InputReading,
    InputSource,
)

HERE = InputIdentity("good:1", "Good stick", "good")


class GoodStick(InputDevice):
    identity = HERE
    axes = ("X",)
    buttons = ("Trigger",)

    def __init__(self, clock):
        self.clock, self.is_open = clock, True

    def read(self):
        if not self.is_open:
            raise StateError("closed")
        return (InputReading(self.clock(), (0.5,), (False,)),)

    def close(self):
        self.is_open = False


class GoodSource(InputSource):
    stick = GoodStick

    def devices(self):
        return (HERE,)

    def open(self, identity):
        if identity != HERE:
            raise InputLostError("not plugged in")
        return self.stick(self.clock)


def verdicts(source):
    return {result.name: (str(result.verdict), result.note) for result in check_inputs(source)}


def test_a_good_source_passes():
    assert {verdict for verdict, _ in verdicts(GoodSource).values()} == {"passed"}


def stick_that_says(reading_of):
    class Stick(GoodStick):
        def read(self):
            return (*super().read(), reading_of(self.clock()))

    return type("Source", (GoodSource,), {"stick": Stick})


@pytest.mark.parametrize(
    ("reading_of", "said"),
    [
        (lambda now: InputReading(now, (), (False,)), "0 axes in a reading; expected: 1"),
        (lambda now: InputReading(now, (0.0,), ()), "0 buttons in a reading; expected: 1"),
        (lambda now: InputReading(now, (1.5,), (False,)), "deflections [1.5]"),
        (lambda now: InputReading(now - 1.0, (0.0,), (False,)), "never go back"),
        (lambda now: InputReading(now + 1.0, (0.0,), (False,)), "never go back, none to come"),
        (lambda now: None, "it raised AttributeError"),
    ],
)
def test_a_bad_reading_is_found(reading_of, said):
    verdict, note = verdicts(stick_that_says(reading_of))["read"]
    assert verdict == "failed"
    assert said in note


def test_nan_is_no_fault():
    source = stick_that_says(lambda now: InputReading(now, (float("nan"),), (False,)))
    assert verdicts(source)["read"] == ("passed", "")


def test_other_faults_are_found():
    class Careless(GoodStick):
        def close(self):
            pass

    class Twice(GoodSource):
        stick = Careless

        def devices(self):
            return (HERE, HERE)

        def open(self, identity):
            return self.stick(self.clock)

    found = verdicts(Twice)
    assert found["listed"] == ("failed", "keys ['good:1', 'good:1']; expected: no key twice")
    assert "could be read when it was closed" in found["closed"][1]
    assert "it opened a device that it never listed" in found["strange"][1]


def test_what_needs_a_device_is_skipped_without_one():
    class Empty(GoodSource):
        problem = "the cable is loose"

        def devices(self):
            return ()

    assert verdicts(Empty)["read"] == ("skipped", "the cable is loose")
