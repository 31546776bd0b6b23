"""The input check detects every fault of a source of input devices."""

import pytest

from rotemina.app.plugin_kit import check_inputs
from rotemina.drivers import StateError
from rotemina.drivers.contract import InputLostError
from rotemina.drivers.inputs import InputDevice, InputIdentity, InputReading, InputSource

IDENTITY = InputIdentity("good:1", "Good stick", "good")


class GoodStick(InputDevice):
    identity = IDENTITY
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
        return (IDENTITY,)

    def open(self, identity):
        if identity != IDENTITY:
            raise InputLostError("not plugged in")
        return self.stick(self.clock)


def get_verdicts(source):
    return {result.name: (str(result.verdict), result.note) for result in check_inputs(source)}


def test_good_source_passes():
    assert {verdict for verdict, _ in get_verdicts(GoodSource).values()} == {"passed"}


def make_source_with_reading(make_reading):
    class Stick(GoodStick):
        def read(self):
            return (*super().read(), make_reading(self.clock()))

    return type("Source", (GoodSource,), {"stick": Stick})


@pytest.mark.parametrize(
    ("make_reading", "message"),
    [
        (lambda now: InputReading(now, (), (False,)), "0 axes in a reading; expected: 1"),
        (lambda now: InputReading(now, (0.0,), ()), "0 buttons in a reading; expected: 1"),
        (lambda now: InputReading(now, (1.5,), (False,)), "deflections [1.5]"),
        (lambda now: InputReading(now - 1.0, (0.0,), (False,)), "never decrease"),
        (
            lambda now: InputReading(now + 1.0, (0.0,), (False,)),
            "never decrease and are not in the future",
        ),
        (lambda now: None, "it raised AttributeError"),
    ],
)
def test_bad_reading_is_detected(make_reading, message):
    verdict, note = get_verdicts(make_source_with_reading(make_reading))["read"]
    assert verdict == "failed"
    assert message in note


def test_nan_is_accepted():
    source = make_source_with_reading(lambda now: InputReading(now, (float("nan"),), (False,)))
    assert get_verdicts(source)["read"] == ("passed", "")


def test_other_faults_are_detected():
    class UnclosedStick(GoodStick):
        def close(self):
            pass

    class DuplicateSource(GoodSource):
        stick = UnclosedStick

        def devices(self):
            return (IDENTITY, IDENTITY)

        def open(self, identity):
            return self.stick(self.clock)

    verdicts = get_verdicts(DuplicateSource)
    assert verdicts["listed"] == ("failed", "keys ['good:1', 'good:1']; expected: no key twice")
    assert "could be read when it was closed" in verdicts["closed"][1]
    assert "it opened a device that it never listed" in verdicts["strange"][1]


def test_checks_that_need_a_device_are_skipped_without_one():
    class Empty(GoodSource):
        problem = "the cable is loose"

        def devices(self):
            return ()

    assert get_verdicts(Empty)["read"] == ("skipped", "the cable is loose")
