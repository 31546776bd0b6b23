import numpy as np
import pytest

from rotemina.app.motion.teleoperation.axis_calibration import AxisCalibration, CalibrationError
from rotemina.app.motion.teleoperation.stick_calibration import CalibrationRun
from rotemina.drivers.inputs.device import InputReading


def run(rest, sweep, **options):
    """Return a run that saw one axis at rest and then being moved."""
    one = CalibrationRun(["X"], **options)
    for raw in rest:
        one.feed(InputReading(0.0, (raw,), ()))
    one.sweep()
    for raw in sweep:
        one.feed(InputReading(1.0, (raw,), ()))
    return one


def test_centre_ends_and_noise_become_a_calibration():
    noise = np.random.default_rng(1).normal(0.05, 0.01, 200)
    axis = run(noise, [-0.7, 0.9]).sound()["X"]
    assert axis.centre == pytest.approx(0.05, abs=0.01)
    assert all(axis.deflection(raw) == 0.0 for raw in noise)
    assert (axis.deflection(-0.7), axis.deflection(0.9)) == (-1.0, 1.0)
    assert axis.dead_zone < 0.1


def test_ends_are_reached_although_the_hand_comes_a_little_short():
    axis = run([0.0], [-1.0, 1.0]).sound()["X"]
    assert (axis.deflection(-0.985), axis.deflection(0.985)) == (-1.0, 1.0)


def test_a_bad_axis_does_not_keep_the_others_from_being_calibrated():
    both = CalibrationRun(["X", "Y"])
    both.feed(InputReading(0.0, (0.1, 0.0), ()))
    both.sweep()
    for raw in (-0.8, 0.9):
        both.feed(InputReading(1.0, (raw, 0.01), ()))
    assert list(both.problems) == ["Y"]
    before = {"X": AxisCalibration(expo=0.3), "Y": AxisCalibration()}
    sound = both.sound(before)
    assert list(sound) == ["X"]
    assert (sound["X"].centre, sound["X"].expo) == (0.1, 0.3)


def test_a_silent_device_is_at_rest_where_it_spoke_last():
    last = InputReading(0.0, (0.1,), ())
    axis = run([], [-1.0, 1.0], last=last).sound()["X"]
    assert axis.centre == 0.1
    assert axis.dead_zone == pytest.approx(0.04 * 0.9)


def test_a_potentiometer_may_use_part_of_its_range_only():
    axis = run([0.30, 0.301], [0.19, 0.42]).sound()["X"]
    assert (axis.deflection(0.3), axis.deflection(0.19), axis.deflection(0.42)) == (0.0, -1.0, 1.0)


@pytest.mark.parametrize(("rest", "end"), [(-0.97, 1.0), (0.96, -1.0)])
def test_a_trigger_is_one_sided(rest, end):
    axis = run([rest], [-rest, end, np.copysign(1.0, rest)], one_sided=["X"]).sound()["X"]
    assert axis.centre == rest
    assert axis.deflection(rest) == 0.0
    assert axis.deflection(np.copysign(1.0, rest)) == 0.0
    assert axis.deflection(end) == np.copysign(1.0, end)


@pytest.mark.parametrize(
    ("rest", "sweep", "options", "said"),
    [
        ([0.0], [-0.05, 0.05], {}, "hardly moved: -0.05 to 0.05"),
        ([-1.0], [-1.0, 1.0], {}, "rests at an end: rest -1.00"),
        ([0.9], [-1.0, 1.0], {}, "rests at an end: rest 0.90"),
        ([0.0, 0.5], [-1.0, 1.0], {}, "jitters at rest, or was moved: 0.00 to 0.50"),
        ([0.0], [-1.0, 1.0], {"one_sided": ["X"]}, "does not rest at an end"),
        ([], [-1.0, 1.0], {}, "reported nothing at rest"),
        ([float("nan")], [-1.0, 1.0], {}, "reported nothing at rest"),
    ],
)
def test_what_is_no_stick_is_refused(rest, sweep, options, said):
    one = run(rest, sweep, **options)
    assert said in one.problems["X"]
    assert one.sound() == {}


def test_axes_that_are_not_wanted_may_stand_anywhere():
    one = CalibrationRun(["X", "Slider"], wanted=["X"])
    one.feed(InputReading(0.0, (0.0, -1.0), ()))
    one.sweep()
    for raw in (-1.0, 1.0):
        one.feed(InputReading(0.0, (raw, -1.0), ()))
    assert list(one.sound()) == ["X"]
    assert one.ranges == {"X": (-1.0, 1.0)}
    with pytest.raises(CalibrationError, match=r"'Q'.*has X, Slider"):
        CalibrationRun(["X", "Slider"], wanted=["Q"])


def test_curve_sense_and_travel_stay():
    before = {"X": AxisCalibration(expo=0.5, inverted=True, travel_m=0.03)}
    axis = run([0.0], [-1.0, 1.0]).sound(before)["X"]
    assert (axis.expo, axis.inverted, axis.travel_m) == (0.5, True, 0.03)


@pytest.mark.parametrize("seed", range(50))
def test_every_result_is_a_possible_calibration(seed):
    """Whatever a hand does: a result, or a reason."""
    random = np.random.default_rng(seed)
    rest = random.uniform(-1, 1) + random.uniform(0, 0.2) * random.uniform(-1, 1, 20)
    sweep = random.uniform(-1, 1, 10)
    one = run(np.clip(rest, -1, 1), sweep, one_sided=["X"] if seed % 2 else [])
    if not one.problems:
        axis = one.sound()["X"]
        assert all(axis.deflection(raw) == 0.0 for raw in np.clip(rest, -1, 1))
