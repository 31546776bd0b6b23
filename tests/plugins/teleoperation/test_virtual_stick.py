"""Keys and the pointer on the pad become deflections, which end with their release."""

import pytest

from rotemina.app.motion.inputs import OperatorAction
from rotemina.app.motion.inputs.axis_calibration import DEFAULT_AXIS_CALIBRATION
from rotemina.app.operation.operation import PAD_BUTTONS, PAD_LEASE_S
from rotemina.drivers.contract import VirtualClock
from rotemina.drivers.inputs import InputPad
from rotemina.plugins.teleoperation.virtual_stick import PadKey, VirtualStick


class PadBench:
    """A virtual stick, its pad, and the readings of the pad."""

    def __init__(self):
        self.clock = VirtualClock(3.0)
        self.pad = InputPad("pad", buttons=PAD_BUTTONS, lease_s=PAD_LEASE_S, clock=self.clock)
        self.stick = VirtualStick(self.pad)
        self._device = self.pad.open(self.pad.identity)
        self._last = self._device.read()[-1]

    @property
    def output(self):
        """Deflections of the uncalibrated device, and the set of held buttons."""
        self._last = (self._last, *self._device.read())[-1]
        deflections = tuple(
            round(DEFAULT_AXIS_CALIBRATION.compute_deflection(raw), 9) for raw in self._last.axes
        )
        held_buttons = {
            button
            for button, is_down in zip(PAD_BUTTONS, self._last.buttons, strict=True)
            if is_down
        }
        return deflections, held_buttons


@pytest.fixture
def bench():
    return PadBench()


def test_a_key_is_a_full_deflection_until_its_release(bench):
    for key, deflections in (
        (PadKey.LEFT, (-1, 0, 0)),
        (PadKey.RIGHT, (1, 0, 0)),
        (PadKey.NEAR, (0, -1, 0)),
        (PadKey.AWAY, (0, 1, 0)),
        (PadKey.LOWER, (0, 0, -1)),
        (PadKey.RAISE, (0, 0, 1)),
    ):
        bench.stick.press(key)
        assert bench.output == (deflections, set())
        bench.stick.release(key)
        assert bench.output == ((0, 0, 0), set())
        assert not bench.stick.busy


def test_opposite_keys_cancel_each_other(bench):
    bench.stick.press(PadKey.LEFT)
    bench.stick.press(PadKey.RIGHT)
    bench.stick.press(PadKey.AWAY)
    assert bench.output == ((0, 1, 0), set())
    bench.stick.release(PadKey.LEFT)
    assert bench.output == ((1, 1, 0), set())


@pytest.mark.parametrize("maximum", [0.1, 1.0])
def test_the_maximum_deflection_is_reached_despite_the_dead_zone(bench, maximum):
    bench.stick.max_deflection = maximum
    bench.stick.press(PadKey.RIGHT)
    assert bench.output == ((maximum, 0, 0), set())
    bench.stick.release(PadKey.RIGHT)
    bench.stick.drag(x=-0.5, y=7.0, z=0.5)
    assert bench.stick.dragging
    assert bench.output == ((-0.5 * maximum, maximum, 0.5 * maximum), set())
    bench.stick.release_pointer()
    assert bench.output == ((0, 0, 0), set())


def test_the_clutch_can_be_held_with_a_direction(bench):
    bench.stick.press(PadKey.RIGHT)
    bench.stick.press(PadKey.CLUTCH)
    assert bench.output == ((1, 0, 0), {OperatorAction.CLUTCH})


def test_another_scale_ends_all_deflections(bench):
    bench.stick.set_scaling(fine=True, coarse=False)
    bench.stick.press(PadKey.RIGHT)
    bench.stick.set_scaling(fine=True, coarse=False)  # the same setting again
    assert bench.output == ((1, 0, 0), {OperatorAction.FINE})
    bench.stick.set_scaling(fine=False, coarse=False)
    assert bench.output == ((0, 0, 0), set())
    bench.stick.drag(x=1.0)
    bench.stick.set_scaling(fine=False, coarse=True)
    assert bench.output == ((0, 0, 0), {OperatorAction.COARSE})


def test_everything_is_released_at_once(bench):
    bench.stick.set_scaling(fine=True, coarse=True)
    bench.stick.press(PadKey.RAISE)
    bench.stick.press(PadKey.CLUTCH)
    bench.stick.take_over(True)
    bench.stick.drag(x=1.0)
    bench.stick.release_all()
    assert bench.output == ((0, 0, 0), set())
    assert not bench.stick.busy
    bench.stick.press(PadKey.RAISE)  # later keys count again
    assert bench.output == ((0, 0, 1), set())


def test_deflections_expire_while_the_window_hangs(bench):
    bench.stick.press(PadKey.RIGHT)
    for _ in range(5):
        bench.clock.advance(0.8 * PAD_LEASE_S)
        bench.stick.renew()
    assert bench.output == ((1, 0, 0), set())
    bench.clock.advance(1.1 * PAD_LEASE_S)
    assert bench.output == ((0, 0, 0), set())
    bench.stick.renew()
    assert not bench.stick.busy
    assert bench.output == ((0, 0, 0), set())
