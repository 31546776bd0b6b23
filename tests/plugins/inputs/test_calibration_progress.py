"""Calibration of an input device, step by step and by typed values."""

import pytest

from rotemina.app.errors import InputCalibrationError
from rotemina.app.motion.inputs import InputAxisCalibration
from rotemina.plugins.inputs.calibration_progress import (
    REST_DURATION_S,
    CalibrationProgress,
    CalibrationStep,
)


@pytest.fixture
def stick(make_stick):
    return make_stick(axes=("X", "Y", "Brake", "Hat right"))


def run_calibration(bench, stick, progress, axes=("X", "Y"), moves=(), one_sided=()):
    view = bench.view(stick.key)
    progress.begin(axes, one_sided, view.latest_reading, bench.clock())
    receive_updates(bench, progress, stick, REST_DURATION_S)
    progress.start_sweep()
    for axis, raw in moves:
        stick.deflect(axis, raw)
        receive_updates(bench, progress, stick, 0.05)


def receive_updates(bench, progress, stick, seconds):
    for update in bench.run(seconds):
        progress.receive(update.readings.get(stick.key, ()))


def test_measured_rest_and_ends_become_a_draft_that_is_not_used_yet(make_bench, stick):
    bench = make_bench(stick)
    progress = CalibrationProgress(bench.view(stick.key))
    assert progress.measurable_axes == ("X", "Y", "Brake")
    assert progress.one_sided_axes == ("Brake",)
    moves = [("X", -0.8), ("X", 0.9), ("X", 0.0), ("Y", -1.0), ("Y", 1.0)]
    run_calibration(bench, stick, progress, moves=moves)
    assert progress.step is CalibrationStep.SWEEP
    assert progress.open_problems == {}
    assert progress.ranges["X"] == (-0.8, 0.9)
    progress.finish()
    assert progress.step is CalibrationStep.EDIT
    assert progress.draft.find_axis("X").low == pytest.approx(-0.8, abs=0.02)
    assert progress.is_changed
    assert bench.view(stick.key).calibration == progress.calibration_in_use
    bench.devices.use_calibration(stick.key, progress.draft)
    assert bench.view(stick.key).calibration == progress.draft


def test_the_rest_phase_lasts_a_fixed_time(make_bench, stick):
    bench = make_bench(stick)
    progress = CalibrationProgress(bench.view(stick.key))
    assert progress.compute_remaining_rest_s(bench.clock()) == 0.0
    progress.begin(["X"], (), None, bench.clock())
    assert progress.compute_remaining_rest_s(bench.clock()) == REST_DURATION_S
    assert progress.compute_remaining_rest_s(bench.clock() + 2 * REST_DURATION_S) == 0.0


def test_readings_from_before_the_rest_phase_are_ignored(make_bench, stick):
    bench = make_bench(stick)
    stick.deflect("X", 0.5)
    earlier_updates = bench.run(0.05)
    stick.deflect("X", 0.0)
    view = bench.view(stick.key)
    progress = CalibrationProgress(view)
    progress.begin(["X"], (), view.latest_reading, bench.clock())
    for update in earlier_updates:  # the panel receives them late
        progress.receive(update.readings[stick.key])
    assert progress.ranges["X"] == (0.0, 0.0)


def test_a_badly_measured_axis_keeps_its_calibration_with_a_reason(make_bench, stick):
    bench = make_bench(stick)
    progress = CalibrationProgress(bench.view(stick.key))
    run_calibration(bench, stick, progress, moves=[("X", -1.0), ("X", 1.0), ("Y", 0.05)])
    assert "axis Y hardly moved" in progress.open_problems["Y"]
    progress.finish()
    assert list(progress.draft.axes) == ["X"]
    assert list(progress.problems) == ["Y"]
    progress.discard()
    assert not progress.is_changed
    assert progress.problems == {}


def test_a_cancelled_calibration_changes_nothing(make_bench, stick):
    bench = make_bench(stick)
    progress = CalibrationProgress(bench.view(stick.key))
    run_calibration(bench, stick, progress, moves=[("X", -1.0), ("X", 1.0)])
    progress.cancel()
    assert (progress.step, progress.is_changed) == (CalibrationStep.EDIT, False)
    assert progress.open_problems == progress.ranges == {}


def test_a_calibration_without_axes_is_refused(make_bench, stick):
    progress = CalibrationProgress(make_bench(stick).view(stick.key))
    with pytest.raises(InputCalibrationError, match="no axis is chosen"):
        progress.begin((), (), None, 0.0)


def test_settings_are_changed_and_reset(make_bench, stick):
    progress = CalibrationProgress(make_bench(stick).view(stick.key))
    progress.change_axis("X", expo=0.4, travel_m=0.02)
    progress.change_axis("X", inverted=True)
    assert progress.draft.find_axis("X") == InputAxisCalibration(
        expo=0.4, travel_m=0.02, inverted=True
    )
    progress.reset_axis("X")
    assert progress.draft == progress.calibration_in_use


def test_inconsistent_settings_are_refused(make_bench, stick):
    progress = CalibrationProgress(make_bench(stick).view(stick.key))
    progress.change_axis("X", low=-0.3, high=0.3)
    with pytest.raises(
        InputCalibrationError, match=r"^axis X, its settings: from centre 0 to low -0.3"
    ):
        progress.change_axis("X", dead_zone=0.4)
    with pytest.raises(InputCalibrationError, match=r"^axis X, expo: .* less than or equal to 1"):
        progress.change_axis("X", expo=2.0)
    assert progress.draft.find_axis("X").expo == 0.0
