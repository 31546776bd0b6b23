"""Clicks: the microscope's acceptance test, and refusals."""

import numpy as np
import pytest

from rotemina.app.errors import MicroscopeError, RequestRefusedError
from rotemina.app.microscope import MICRO, NANO, VisitState
from rotemina.app.microscope.click_corrections import VisitRun
from rotemina.app.microscope.click_target import ClickMover
from rotemina.sim.errors import OutOfLimitsError
from rotemina.sim.robot import AxisEffect


def start_visit(bench, clicks, pixel, **options):
    move = clicks.plan(np.asarray(pixel), frame=bench.frame, **options)
    return VisitRun(
        clicks,
        bench.get_newest_frame,
        move,
        bench.track_tip(),
        now_s=bench.clock(),
        earlier_image=bench.make_grey_image(),
        confirmed=True,
    )


def test_click_after_calibration_lands_within_half_a_pixel(bench):
    clicks = ClickMover(bench.session, bench.calibrate_stages(MICRO, NANO))
    for pixel in ((250.4, 200.7), (430.0, 330.2), bench.make_offset_pixel(12.3, -7.9), (500, 100)):
        status = bench.run_until_finished(start_visit(bench, clicks, pixel))
        assert status.state is VisitState.ARRIVED, status.reason
        assert np.linalg.norm(bench.true_pixel() - pixel) < 0.5


def test_hysteresis_is_corrected_until_the_tip_arrives(make_bench):
    bench = make_bench(
        effects=[
            AxisEffect(axis=axis, id="hysteresis", parameters={"width": 0.12 * 1.16e-3})
            for axis in ("thx", "thy")
        ]
    )
    clicks = ClickMover(bench.session, bench.make_true_calibration())
    pixel = bench.make_offset_pixel(40.0, 25.0)
    status = bench.run_until_finished(start_visit(bench, clicks, pixel, stage=NANO))
    assert status.state is VisitState.ARRIVED, status.reason
    assert status.corrections >= 1
    assert np.linalg.norm(bench.true_pixel() - pixel) < 0.5


@pytest.fixture
def clicks(bench):
    return ClickMover(bench.session, bench.make_true_calibration())


def test_near_click_uses_the_nano_stage_and_far_click_the_micro_stage(bench, clicks):
    assert clicks.plan(bench.make_offset_pixel(30.0, 0.0)).stage == NANO
    far_move = clicks.plan(np.array([600.0, 480.0]))
    assert far_move.stage == MICRO
    assert set(far_move.targets) == {"x", "y"}
    with pytest.raises(OutOfLimitsError, match="axis th"):
        clicks.plan(np.array([600.0, 480.0]), stage=NANO)


def test_ghost_predicts_the_tip_before_the_move(bench, clicks):
    before = dict(bench.session.snapshot().command)
    move = clicks.plan(np.array([400.0, 300.0]))
    assert move.predicted_px == pytest.approx([400.0, 300.0], abs=0.05)
    bench.step(5)
    assert bench.session.snapshot().command == before
    clicks.go(move)
    bench.step(60)
    assert bench.true_pixel() == pytest.approx(move.predicted_px, abs=0.5)


@pytest.mark.parametrize("pixel", [(-5.0, 100.0), (700.0, 100.0), (100.0, 520.0), (np.nan, 1.0)])
def test_click_outside_the_calibrated_field_is_refused(clicks, pixel):
    with pytest.raises(MicroscopeError, match="outside the calibrated field"):
        clicks.plan(np.array(pixel))


def test_click_without_calibration_is_refused(bench):
    with pytest.raises(MicroscopeError, match="not calibrated"):
        ClickMover(bench.session, None).plan(np.array([10.0, 10.0]))
    with pytest.raises(MicroscopeError, match="micro stage is not calibrated"):
        ClickMover(bench.session, bench.make_empty_calibration()).plan(np.array([10.0, 10.0]))


def test_click_in_a_picture_of_another_resolution_is_refused(make_bench, clicks):
    other = make_bench({"width": 400, "height": 300})
    with pytest.raises(MicroscopeError, match="400 × 300 px"):
        clicks.plan(np.array([10.0, 10.0]), frame=other.frame)


def test_keep_out_and_locks_apply_to_clicks(bench, clicks):
    move = clicks.plan(np.array([300.0, 250.0]))
    height = bench.session.bounds.teach_floor()
    bench.session.bounds._guard.teach_floor(height + 1e-6)
    with pytest.raises(OutOfLimitsError, match="floor"):
        clicks.go(move)
    bench.session.bounds.clear_floor()
    bench.session.bar_motion("somebody works at the dish")
    with pytest.raises(RequestRefusedError, match="works at the dish"):
        clicks.go(move)


def test_misplaced_tip_ends_the_visit_without_correction(bench, clicks):
    run = start_visit(bench, clicks, [400.0, 300.0])
    bench.camera.move_focus(400e-6)
    status = bench.run_until_finished(run)
    assert status.state is VisitState.FAILED
    assert status.corrections == 0
