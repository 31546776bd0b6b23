import numpy as np
import pytest

from rotemina.app.errors import InputCalibrationError
from rotemina.app.motion.inputs import InputAxisCalibration, StickCalibrationRun
from rotemina.drivers.inputs import InputReading


def calibrate(rest, sweep, **options):
    """Return a calibration run that received one axis at rest and then its sweep."""
    calibration_run = StickCalibrationRun(["X"], **options)
    for raw in rest:
        calibration_run.feed(InputReading(0.0, (raw,), ()))
    calibration_run.begin_sweep()
    for raw in sweep:
        calibration_run.feed(InputReading(1.0, (raw,), ()))
    return calibration_run


def test_centre_ends_and_noise_become_a_calibration():
    noise = np.random.default_rng(1).normal(0.05, 0.01, 200)
    axis = calibrate(noise, [-0.7, 0.9]).make_calibrations()["X"]
    assert axis.centre == pytest.approx(0.05, abs=0.01)
    assert all(axis.compute_deflection(raw) == 0.0 for raw in noise)
    assert (axis.compute_deflection(-0.7), axis.compute_deflection(0.9)) == (-1.0, 1.0)
    assert axis.dead_zone < 0.1


def test_ends_are_reached_even_slightly_short_of_the_sweep():
    axis = calibrate([0.0], [-1.0, 1.0]).make_calibrations()["X"]
    assert (axis.compute_deflection(-0.985), axis.compute_deflection(0.985)) == (-1.0, 1.0)


def test_a_bad_axis_does_not_prevent_calibrating_the_others_whose_curve_is_kept():
    calibration_run = StickCalibrationRun(["X", "Y"])
    calibration_run.feed(InputReading(0.0, (0.1, 0.0), ()))
    calibration_run.begin_sweep()
    for raw in (-0.8, 0.9):
        calibration_run.feed(InputReading(1.0, (raw, 0.01), ()))
    assert list(calibration_run.problems) == ["Y"]
    before = InputAxisCalibration(expo=0.5, inverted=True, travel_m=0.03)
    calibrated = calibration_run.make_calibrations({"X": before, "Y": InputAxisCalibration()})
    assert list(calibrated) == ["X"]
    axis = calibrated["X"]
    assert (axis.centre, axis.expo, axis.inverted, axis.travel_m) == (0.1, 0.5, True, 0.03)


def test_a_silent_device_rests_at_its_last_reading():
    last = InputReading(0.0, (0.1,), ())
    axis = calibrate([], [-1.0, 1.0], last_reading=last).make_calibrations()["X"]
    assert axis.centre == 0.1
    assert axis.dead_zone == pytest.approx(0.04 * 0.9)


def test_a_potentiometer_may_use_only_part_of_its_range():
    axis = calibrate([0.30, 0.301], [0.19, 0.42]).make_calibrations()["X"]
    assert (
        axis.compute_deflection(0.3),
        axis.compute_deflection(0.19),
        axis.compute_deflection(0.42),
    ) == (0.0, -1.0, 1.0)


@pytest.mark.parametrize(("rest", "end"), [(-0.97, 1.0), (0.96, -1.0)])
def test_a_trigger_is_one_sided(rest, end):
    axis = calibrate(
        [rest], [-rest, end, np.copysign(1.0, rest)], one_sided=["X"]
    ).make_calibrations()["X"]
    assert axis.centre == rest
    assert axis.compute_deflection(rest) == 0.0
    assert axis.compute_deflection(np.copysign(1.0, rest)) == 0.0
    assert axis.compute_deflection(end) == np.copysign(1.0, end)


@pytest.mark.parametrize(
    ("rest", "sweep", "options", "message"),
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
def test_impossible_sweeps_are_refused(rest, sweep, options, message):
    calibration_run = calibrate(rest, sweep, **options)
    assert message in calibration_run.problems["X"]
    assert calibration_run.make_calibrations() == {}


def test_unselected_axes_may_be_at_any_position():
    calibration_run = StickCalibrationRun(["X", "Slider"], selected_axes=["X"])
    calibration_run.feed(InputReading(0.0, (0.0, -1.0), ()))
    calibration_run.begin_sweep()
    for raw in (-1.0, 1.0):
        calibration_run.feed(InputReading(0.0, (raw, -1.0), ()))
    assert list(calibration_run.make_calibrations()) == ["X"]
    assert calibration_run.ranges == {"X": (-1.0, 1.0)}
    with pytest.raises(InputCalibrationError, match=r"'Q'.*has X, Slider"):
        StickCalibrationRun(["X", "Slider"], selected_axes=["Q"])


@pytest.mark.parametrize("seed", range(12))
def test_every_result_is_a_valid_calibration(seed):
    """Any input leads to a result or to a reason."""
    random = np.random.default_rng(seed)
    rest = random.uniform(-1, 1) + random.uniform(0, 0.2) * random.uniform(-1, 1, 20)
    sweep = random.uniform(-1, 1, 10)
    calibration_run = calibrate(np.clip(rest, -1, 1), sweep, one_sided=["X"] if seed % 2 else [])
    if not calibration_run.problems:
        axis = calibration_run.make_calibrations()["X"]
        assert all(axis.compute_deflection(raw) == 0.0 for raw in np.clip(rest, -1, 1))
