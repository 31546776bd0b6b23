"""Guided calibrations on the simulated microscope find the hidden mounting or fail."""

from dataclasses import replace
from datetime import UTC, datetime
from itertools import cycle

import numpy as np
import pytest

from rotemina.app.errors import RequestRefusedError
from rotemina.app.microscope import MICRO, StageCalibrationPhase
from rotemina.drivers.cameras import SensorRegion
from rotemina.sim.errors import OutOfLimitsError
from rotemina.sim.robot import AxisEffect


def test_calibration_finds_the_hidden_mounting_and_moves_back(bench):
    before = dict(bench.session.snapshot().command)
    status = bench.run_until_finished(
        bench.start_calibration(MICRO, read_date=lambda: datetime(2026, 11, 21, tzinfo=UTC))
    )
    assert status.phase is StageCalibrationPhase.DONE, status.reason
    measured, true_geometry = status.fit.map.geometry, bench.true_map().geometry
    for size, true_size in zip(measured.pixel_size, true_geometry.pixel_size, strict=True):
        assert size == pytest.approx(true_size, rel=1e-3)
    assert np.degrees(abs(measured.rotation - true_geometry.rotation)) < 0.05
    assert np.degrees(abs(measured.skew - true_geometry.skew)) < 0.1
    assert measured.handedness == true_geometry.handedness == -1
    assert status.fit.residual_rms < 0.2
    assert status.calibration.date == "2026-11-21T00:00:00+00:00"
    assert bench.session.snapshot().command == pytest.approx(before, abs=1e-9)
    assert status.calibration.tip_px == pytest.approx(bench.true_pixel(), abs=0.3)


def start_and_take_pictures(bench, count):
    """Start a calibration, and return it after ``count`` pictures."""
    run = bench.start_calibration()
    bench.run_until(run, lambda status: status.pictures_taken >= count)
    return run


def test_stop_ends_the_calibration_in_place(bench):
    run = start_and_take_pictures(bench, 2)
    bench.session.stop()
    bench.step()
    assert run.step(bench.clock()).phase is StageCalibrationPhase.FAILED
    assert "stopped" in run.status.reason
    stop_position = dict(bench.session.snapshot().command)
    for _ in range(20):
        bench.step()
        run.step(bench.clock())
    assert bench.session.snapshot().command == stop_position


class FrameFaults:
    """Faults of a camera, as functions that change its frames."""

    @staticmethod
    def freeze(bench):
        frozen_frame = bench.frame
        return lambda frame: replace(frame, pixels=frozen_frame.pixels)

    @staticmethod
    def cycle_buffers(bench):
        """Repeat the pictures from before the latest move one after another."""
        buffers = cycle(bench.recent_pixels[-3:])
        return lambda frame: replace(frame, pixels=next(buffers))

    @staticmethod
    def stall(bench):
        last_frame = bench.frame
        return lambda _: last_frame

    @staticmethod
    def darken(bench):
        return lambda frame: replace(frame, pixels=np.clip(frame.pixels, 0, 45))

    @staticmethod
    def crop(bench):
        def crop_frame(frame):
            region = SensorRegion(0, 0, 400, 300)
            return replace(frame, pixels=frame.pixels[:300, :400], region=region)

        return crop_frame

    @staticmethod
    def show_noise(bench):
        rng = np.random.default_rng(0)

        def replace_with_noise(frame):
            pixels = rng.normal(2000.0, 30.0, frame.pixels.shape).astype(np.uint16)
            return replace(frame, pixels=pixels)

        return replace_with_noise


@pytest.mark.parametrize(
    ("make_fault", "message"),
    [
        (FrameFaults.freeze, "frozen"),
        (FrameFaults.cycle_buffers, "frozen"),
        (FrameFaults.stall, "stalled"),
        (FrameFaults.darken, "black"),
        (FrameFaults.crop, "400 × 300 px"),
    ],
)
def test_faulty_picture_ends_the_calibration_without_further_moves(bench, make_fault, message):
    run = bench.start_calibration()
    bench.recent_pixels = []
    while run.status.pictures_taken < 1:
        bench.step()
        bench.recent_pixels.append(bench.frame.pixels)
        run.step(bench.clock())
    bench.transform_frame = make_fault(bench)
    status = bench.run_until_finished(run)
    assert status.phase is StageCalibrationPhase.FAILED
    assert message in status.reason
    assert status.calibration is None


def test_featureless_picture_is_refused_before_any_move(bench):
    bench.transform_frame = FrameFaults.show_noise(bench)
    bench.step()
    before = dict(bench.session.snapshot().command)
    status = bench.run_until_finished(bench.start_calibration())
    assert status.phase is StageCalibrationPhase.FAILED
    assert "nothing in the picture matches it" in status.reason
    assert bench.session.snapshot().command == before


def test_lost_tip_sends_the_stage_back_to_the_start(bench):
    before = dict(bench.session.snapshot().command)
    run = start_and_take_pictures(bench, 2)
    bench.transform_frame = FrameFaults.show_noise(bench)
    status = bench.run_until_finished(run)
    assert status.phase is StageCalibrationPhase.FAILED
    assert "nothing in the picture matches it" in status.reason
    assert status.calibration is None
    assert bench.session.snapshot().command == pytest.approx(before, abs=1e-9)


def refuse_return(monkeypatch, bench, run):
    """Refuse the move to the start position, after the last picture of the run."""
    go_to = bench.session.go_to

    def refuse_or_go(targets, *arguments, **options):
        if run.status.phase is StageCalibrationPhase.RETURNING:
            raise RequestRefusedError("axis x is reserved")
        go_to(targets, *arguments, **options)

    monkeypatch.setattr(bench.session, "go_to", refuse_or_go)


def test_refused_return_keeps_the_calibration(bench, monkeypatch):
    run = bench.start_calibration()
    refuse_return(monkeypatch, bench, run)
    status = bench.run_until_finished(run)
    assert status.phase is StageCalibrationPhase.DONE
    assert status.calibration is not None
    assert status.reason == "the return to the start position failed: axis x is reserved"


def test_refused_return_after_a_failed_calibration_is_reported_with_its_reason(bench, monkeypatch):
    run = start_and_take_pictures(bench, 2)
    refuse_return(monkeypatch, bench, run)
    bench.transform_frame = FrameFaults.show_noise(bench)
    status = bench.run_until_finished(run)
    assert status.phase is StageCalibrationPhase.FAILED
    assert status.calibration is None
    assert "nothing in the picture matches it" in status.reason
    assert "the return to the start position failed: axis x is reserved" in status.reason


@pytest.mark.parametrize("is_aborted", [False, True])
def test_only_an_abort_during_the_return_discards_the_calibration(bench, is_aborted):
    run = bench.start_calibration()
    bench.run_until(run, lambda status: status.phase is StageCalibrationPhase.RETURNING)
    if is_aborted:
        run.abort("the operator stopped it")
        assert run.status.phase is StageCalibrationPhase.FAILED
        assert run.status.reason == "the operator stopped it"
        return
    bench.session.stop()
    bench.step()
    status = run.step(bench.clock())
    assert status.phase is StageCalibrationPhase.DONE
    assert "the return to the start position failed" in status.reason
    assert "stopped" in status.reason


def test_stationary_background_fails_the_calibration(bench):
    status = bench.run_until_finished(bench.start_calibration(pipette=False))
    assert status.phase is StageCalibrationPhase.FAILED
    assert "registration" in status.reason or "calibration" in status.reason


@pytest.mark.slow
def test_backlash_unseen_by_the_sensors_is_refused(make_bench):
    backlash_effects = [
        AxisEffect(axis=axis, id="backlash", parameters={"width": 4e-6}) for axis in "xy"
    ]
    bench = make_bench(effects=backlash_effects)
    status = bench.run_until_finished(bench.start_calibration())
    assert status.phase is StageCalibrationPhase.FAILED
    assert "drifted by" in status.reason
    assert status.calibration is None


def test_position_at_the_end_of_the_range_is_refused_at_once(bench):
    bench.session.go_to({"x": 10e-6})
    bench.settle()
    with pytest.raises(OutOfLimitsError, match="axis x"):
        bench.start_calibration()


def test_locked_motion_is_refused_at_once(bench):
    bench.session.bar_motion("a replay is shown")
    with pytest.raises(RequestRefusedError, match="replay"):
        bench.start_calibration()
