"""What is held on the pad becomes deflections, and nothing is left over when it is let go of."""

import pytest

from rotemina.app.motion.operation import PAD_BUTTONS, PAD_LEASE_S
from rotemina.app.motion.teleoperation.axis_calibration import UNCALIBRATED
from rotemina.app.motion.teleoperation.intent import Action
from rotemina.drivers.clock import VirtualClock
from rotemina.drivers.inputs.pad import Pad
from rotemina.plugins.teleoperation.virtual_stick import Key, VirtualStick


class Told:
    """A hand, and what its pad was told."""

    def __init__(self):
        self.clock = VirtualClock(3.0)
        self.pad = Pad("pad", buttons=PAD_BUTTONS, lease_s=PAD_LEASE_S, clock=self.clock)
        self.stick = VirtualStick(self.pad)
        self._device = self.pad.open(self.pad.identity)
        self._last = self._device.read()[-1]

    @property
    def now(self):
        """Deflections as an uncalibrated device has them, and the buttons that are held."""
        self._last = (self._last, *self._device.read())[-1]
        ways = tuple(round(UNCALIBRATED.deflection(raw), 9) for raw in self._last.axes)
        held = {b for b, down in zip(PAD_BUTTONS, self._last.buttons, strict=True) if down}
        return ways, held


@pytest.fixture
def told():
    return Told()


@pytest.mark.parametrize(
    ("key", "ways"),
    [
        (Key.LEFT, (-1, 0, 0)),
        (Key.RIGHT, (1, 0, 0)),
        (Key.NEAR, (0, -1, 0)),
        (Key.AWAY, (0, 1, 0)),
        (Key.LOWER, (0, 0, -1)),
        (Key.RAISE, (0, 0, 1)),
    ],
)
def test_a_key_is_a_full_deflection_until_it_is_let_go_of(told, key, ways):
    told.stick.press(key)
    assert told.now == (ways, set())
    told.stick.release(key)
    assert told.now == ((0, 0, 0), set())
    assert not told.stick.busy


def test_keys_against_each_other_are_none(told):
    told.stick.press(Key.LEFT)
    told.stick.press(Key.RIGHT)
    told.stick.press(Key.AWAY)
    assert told.now == ((0, 1, 0), set())
    told.stick.release(Key.LEFT)
    assert told.now == ((1, 1, 0), set())


@pytest.mark.parametrize("most", [0.1, 0.25, 1.0])
def test_the_deflection_is_what_was_chosen_in_spite_of_the_dead_zone(told, most):
    told.stick.most = most
    told.stick.press(Key.RIGHT)
    assert told.now == ((most, 0, 0), set())
    told.stick.release(Key.RIGHT)
    told.stick.drag(x=-0.5, y=7.0)
    assert told.now == ((-0.5 * most, most, 0), set())


def test_the_pointer_springs_back(told):
    told.stick.drag(z=0.4)
    assert told.stick.dragging
    assert told.now == ((0, 0, 0.4), set())
    told.stick.drop()
    assert told.now == ((0, 0, 0), set())


def test_the_clutch_is_held_with_a_direction(told):
    told.stick.press(Key.RIGHT)
    told.stick.press(Key.CLUTCH)
    assert told.now == ((1, 0, 0), {Action.CLUTCH})


def test_another_scale_ends_what_moves(told):
    told.stick.modify(fine=True, coarse=False)
    told.stick.press(Key.RIGHT)
    told.stick.modify(fine=True, coarse=False)  # said again
    assert told.now == ((1, 0, 0), {Action.FINE})
    told.stick.modify(fine=False, coarse=False)
    assert told.now == ((0, 0, 0), set())
    told.stick.drag(x=1.0)
    told.stick.modify(fine=False, coarse=True)
    assert told.now == ((0, 0, 0), {Action.COARSE})


def test_all_is_let_go_of_at_once(told):
    told.stick.modify(fine=True, coarse=True)
    told.stick.press(Key.RAISE)
    told.stick.press(Key.CLUTCH)
    told.stick.take_over(True)
    told.stick.drag(x=1.0)
    told.stick.release_all()
    assert told.now == ((0, 0, 0), set())
    assert not told.stick.busy
    told.stick.press(Key.RAISE)  # and what comes then is told anew
    assert told.now == ((0, 0, 1), set())


def test_a_screen_that_hung_finds_everything_let_go_of(told):
    told.stick.press(Key.RIGHT)
    for _ in range(5):
        told.clock.advance(0.8 * PAD_LEASE_S)
        told.stick.renew()
    assert told.now == ((1, 0, 0), set())
    told.clock.advance(1.1 * PAD_LEASE_S)
    assert told.now == ((0, 0, 0), set())
    told.stick.renew()
    assert not told.stick.busy
    assert told.now == ((0, 0, 0), set())
