"""The whole microscope on a simulated machine: requests of a panel, and failures."""

import dataclasses
import threading

import numpy as np
import pytest

from rotemina.app.cameras import FeedState
from rotemina.app.errors import MicroscopeError, RequestRefusedError
from rotemina.app.microscope import (
    MicroscopeActivity,
    MicroscopeRunState,
    ScaleSource,
    StageCalibrationPhase,
    TipState,
    VisitState,
    make_reference_record,
)
from rotemina.app.motion.penetration import PenetrationPhase
from rotemina.app.motion.recording import Recording
from rotemina.sim.records import Tap
from rotemina.sim.vision import StageMap


def is_at_rest(rig):
    """Return whether nothing moves from now on."""
    before = dict(rig.session.snapshot().command)
    rig.step(8)
    return rig.session.snapshot().command == before


def step_until_idle(rig):
    return rig.step_until(lambda status: status.activity is MicroscopeActivity.NONE)


def calibrate(rig, stage):
    """Calibrate a stage, and check that it moves back."""
    before = dict(rig.session.snapshot().command)
    rig.microscope.calibrate(stage)
    status = step_until_idle(rig)
    calibration_status = status.calibration_status
    assert calibration_status.phase is StageCalibrationPhase.DONE, calibration_status.reason
    assert rig.session.snapshot().command == pytest.approx(before, abs=1e-9)
    return status


def go_and_arrive(rig, goal):
    """Confirm the planned move, and check that the tip arrives at this pixel."""
    rig.microscope.go(confirmed=True)
    status = step_until_idle(rig)
    assert status.visit_status.state is VisitState.ARRIVED, status.visit_status.reason
    assert np.linalg.norm(rig.true_pixel() - goal) < 0.5


def test_camera_opens_only_once_a_view_reads_the_status(tmp_path, make_rig):
    rig = make_rig(tmp_path)
    rig.step(3)
    assert rig.feed is None
    assert rig.microscope.status.feed.frame is None
    rig.step(3)
    status = rig.microscope.status
    assert status.camera.key == "simulated:microscope"
    assert status.feed.frame is not None
    assert status.scale_source is ScaleSource.ROBOT_FILE
    rig.microscope.camera.close_and_forget()
    rig.step(40)
    assert rig.microscope.status.camera is None  # a camera closed by the user stays closed


def test_tip_is_found_in_any_direction_and_late_pictures_are_skipped(rig):
    rig.microscope.track(True)
    rig.step(2)
    for _ in range(4):
        rig.clock.advance(0.05)
        rig.feed.grab()
    rig.microscope.step(rig.clock())
    status = rig.microscope.status
    assert status.tip.state is TipState.TRACKED
    assert status.tip.pixel == pytest.approx(rig.true_pixel(), abs=0.2)
    assert status.tip.position_m == pytest.approx(rig.true_tip()[:2], abs=0.1e-6)
    assert 0.0 < status.tip.sigma_px < 0.2
    assert status.frames_processed == 3
    assert status.frames_skipped >= 3
    rig.microscope.track(False)
    rig.step()
    assert rig.microscope.status.tip.state is TipState.OFF


def test_click_lands_and_only_one_run_is_allowed_at_a_time(rig):
    rig.start_tracking()
    goal = rig.true_pixel() + np.array([60.0, -40.0])
    move = rig.microscope.plan(goal)
    assert rig.microscope.status.planned_move.predicted_px == pytest.approx(goal, abs=0.1)
    assert is_at_rest(rig)
    assert not move.needs_confirmation
    rig.microscope.go()
    with pytest.raises(MicroscopeError, match="click is under way"):
        rig.microscope.calibrate("micro")
    with pytest.raises(MicroscopeError, match="click is under way"):
        rig.microscope.choose_objective("40x")
    status = step_until_idle(rig)
    assert status.visit_status.state is VisitState.ARRIVED, status.visit_status.reason
    assert rig.true_pixel() == pytest.approx(goal, abs=0.5)
    assert status.tip_path is not None
    assert np.ptp(status.nano_limits, axis=0).min() > 50.0
    with pytest.raises(MicroscopeError, match="no move is planned"):
        rig.microscope.go()


def test_click_is_planned_from_the_current_tip_position(rig):
    rig.start_tracking()
    command = rig.session.snapshot().command
    rig.session.go_to({"x": command["x"] + 20e-6, "y": command["y"] - 15e-6})
    for _ in range(40):  # the camera's pictures are late, and none is processed
        rig.clock.advance(0.05)
        rig.session.run_once()
    assert not rig.session.snapshot().queued
    old_pixel = rig.microscope.status.tip.pixel
    assert np.linalg.norm(rig.true_pixel() - old_pixel) > 50.0
    goal = rig.true_pixel() + np.array([30.0, 20.0])
    rig.microscope.plan(goal)
    go_and_arrive(rig, goal)


def test_click_needs_a_tracked_tip_and_far_click_a_confirmation(rig):
    rig.microscope.plan(rig.true_pixel() + 20.0)
    with pytest.raises(MicroscopeError, match="not tracked"):
        rig.microscope.go()
    rig.start_tracking()
    rig.microscope.plan(np.array([600.0, 60.0]))
    with pytest.raises(MicroscopeError, match="confirm"):
        rig.microscope.go()
    assert rig.microscope.status.activity is MicroscopeActivity.NONE
    rig.microscope.mark_target(np.array([600.0, 60.0]))
    with pytest.raises(MicroscopeError, match="confirm"):
        rig.microscope.visit_next()
    assert is_at_rest(rig)


def freeze_camera(rig):
    frozen_pixels = rig.feed.newest.pixels
    rig.feed.transform_frame = lambda frame: dataclasses.replace(frame, pixels=frozen_pixels)
    rig.step(16)  # a repeated picture counts as frozen after one second


def test_tip_is_lost_while_the_camera_is_frozen(rig):
    rig.start_tracking()
    freeze_camera(rig)
    status = rig.microscope.status
    assert (status.feed.state, status.tip.state) == (FeedState.FROZEN, TipState.LOST)
    assert "the camera is frozen" in status.tip.reason
    rig.feed.transform_frame = lambda frame: frame
    rig.step(2)
    assert rig.microscope.status.tip.state is TipState.TRACKED


def unplug_camera(rig):
    rig.feed.lose("was unplugged")


@pytest.mark.parametrize(
    ("cause_fault", "message"),
    [(freeze_camera, "frozen"), (unplug_camera, "unplugged")],
)
def test_camera_fault_ends_the_calibration(rig, cause_fault, message):
    rig.start_tracking()
    rig.microscope.calibrate("micro")
    rig.step(6)
    assert rig.microscope.status.activity is MicroscopeActivity.CALIBRATION
    cause_fault(rig)
    rig.step(2)
    status = rig.microscope.status
    assert status.activity is MicroscopeActivity.NONE
    assert status.calibration_status.phase is StageCalibrationPhase.FAILED
    assert message in status.calibration_status.reason
    rig.step(5)
    assert is_at_rest(rig)
    with pytest.raises(MicroscopeError, match=message):
        rig.microscope.calibrate("micro")


@pytest.mark.slow
def test_lost_tip_ends_a_click(rig):
    rig.start_tracking()
    rig.microscope.plan(rig.true_pixel() + np.array([250.0, 0.0]))
    rig.microscope.go(confirmed=True)
    rig.feed.camera.move_focus(450e-6)
    status = step_until_idle(rig)
    assert status.visit_status.state is VisitState.FAILED
    assert "tip is" in status.visit_status.reason
    rig.step(5)
    assert is_at_rest(rig)


def test_stop_invalidates_an_earlier_permit_of_a_click_or_visit(rig):
    """A confirmation given before the stop that arrives after it does not move anything."""
    rig.start_tracking()
    pixel = rig.true_pixel() + np.array([20.0, 0.0])
    microscope, session = rig.microscope, rig.microscope.session
    microscope.mark_target(pixel)
    for go in (microscope.go, microscope.visit_next):
        microscope.plan(pixel)
        permit = session.permit()
        session.stop()
        with pytest.raises(RequestRefusedError, match="try again"):
            go(confirmed=True, permit=permit)
        rig.step(2)
        assert is_at_rest(rig)


def test_stop_ends_a_calibration_in_place(rig):
    rig.start_tracking()
    rig.microscope.calibrate("nano")
    rig.step(8)
    rig.microscope.stop()
    rig.step(2)
    status = rig.microscope.status
    assert status.activity is MicroscopeActivity.NONE
    assert status.abort_reason == "stopped"
    assert is_at_rest(rig)


@pytest.mark.slow
def test_autofocus_result_is_kept_for_the_next_start(rig, tmp_path, make_rig):
    rig.start_tracking()
    rig.microscope.procedures.autofocus()
    status = step_until_idle(rig)
    assert status.focus_status.state is MicroscopeRunState.DONE, status.focus_status.reason
    assert rig.feed.camera.focus_m == status.focus_status.peak.place
    assert 0.0 < status.calibration.focus.uncertainty < 1e-6
    # The pipette rises away from the tip, so the sharpest focus lies slightly above the tip.
    assert abs(status.calibration.focus.sharpest) < 6e-6
    restarted_rig = make_rig(tmp_path)
    restarted_rig.find_cameras()
    assert restarted_rig.microscope.status.calibration == status.calibration
    restarted_rig.microscope.choose_objective("40x")
    restarted_rig.step()
    assert restarted_rig.microscope.status.calibration is None
    assert restarted_rig.microscope.status.pixel_m == pytest.approx(0.1675e-6)
    with pytest.raises(MicroscopeError, match="'axes' cannot focus"):
        restarted_rig.microscope.procedures.autofocus("axes")


def test_targets_are_visited_one_after_another(rig):
    rig.start_tracking()
    tip_pixel, cell = rig.true_pixel(), rig.feed.camera.scene.cell
    direction = tip_pixel - rig.optics.pixel_of(np.array(cell.centre_m))
    direction /= np.linalg.norm(direction)
    for distance_px in (40.0, 80.0):
        rig.microscope.mark_target(tip_pixel + distance_px * direction)
    rig.microscope.mark_target(tip_pixel)
    rig.microscope.positioning.target_sequence.remove(2)
    for distance_px in (40.0, 80.0):
        rig.microscope.visit_next()
        with pytest.raises(MicroscopeError, match="moving to a target"):
            rig.microscope.positioning.target_sequence.clear()
        status = step_until_idle(rig)
        assert rig.true_pixel() == pytest.approx(tip_pixel + distance_px * direction, abs=0.5)
    assert [target.visit for target in status.targets] == [VisitState.ARRIVED, VisitState.ARRIVED]
    with pytest.raises(MicroscopeError, match="every target"):
        rig.microscope.visit_next()


def test_cell_outline_measured_line_and_drift(rig):
    rig.start_tracking()
    cell = rig.feed.camera.scene.cell
    middle = rig.optics.pixel_of(np.array(cell.centre_m))
    rig.microscope.outline_cell(middle + 8.0)
    rig.microscope.measure(middle, rig.true_pixel())
    rig.microscope.picture_jobs.watch_drift(True)
    rig.step(3)
    status = rig.microscope.status
    assert status.cell.outline.centre == pytest.approx(middle, abs=1.0)
    distance_m = np.linalg.norm(rig.true_pixel() - middle) * 0.33e-6
    assert status.measured_line.length_m == pytest.approx(distance_m, rel=0.03)
    assert status.drift.is_watched
    rig.microscope.outline_cell(np.array([20.0, 20.0]))
    rig.step()
    assert rig.microscope.status.cell.outline is None
    assert rig.microscope.status.cell.reason


def test_pipette_body_is_learnt_while_a_penetration_is_armed(tmp_path, make_rig):
    phase = [PenetrationPhase.DISARMED]
    rig = make_rig(tmp_path, read_penetration_phase=lambda: phase[0])
    rig.find_cameras()
    rig.start_tracking()
    for phase[0], learnt, dimple in (
        (PenetrationPhase.ARMED, 3, False),
        (PenetrationPhase.THRUST, 3, True),
        (PenetrationPhase.DONE, 0, False),
    ):
        rig.step(3)
        track = rig.microscope.tracker.result.track
        assert (track.learnt_frames, track.dimple) == (learnt, dimple)
        assert track.pixel == pytest.approx(rig.true_pixel(), abs=1.5)


def test_pictures_become_the_reference_of_a_record(tmp_path, make_rig):
    """From frames through a recording to a record whose ``ref`` is the true position."""
    rig = make_rig(tmp_path, seconds=0.04)
    rig.find_cameras()
    rig.store_true_calibration()
    rig.start_tracking()
    recorder = rig.start_recording(tmp_path / "run.arrows")
    start = rig.session.snapshot().command["x"]
    truth = []
    for step in range(36):
        if step == 10:
            rig.session.go_to({"x": start + 30e-6}, speeds={"x": 40e-6})
        rig.step()
        frame = rig.microscope.tracker.result.frame
        truth.append((frame.host_time_s, rig.driver.true_positions[0]))
    recorder.writer.run_once()
    recorder.close()
    recording = Recording.open(tmp_path / "run.arrows")
    frames = recording.read_channel("frames")
    assert np.all(np.diff(frames["number"]) >= 1.0)
    assert np.array_equal(recording.read_channel("tip")["frame"], frames["number"])
    record = make_reference_record(recording, "x")
    reference = record.signal("x", Tap.REF)
    times, positions = np.array(truth).T
    samples = recording.read_samples()
    at_s = np.interp(record.time_s, samples.device_time_s - samples.device_time_s[0],
                     samples.host_time_s)  # fmt: skip
    assert reference == pytest.approx(np.interp(at_s, times, positions), abs=0.1e-6)
    assert np.ptp(reference) == pytest.approx(30e-6, rel=0.01)
    with pytest.raises(MicroscopeError, match="depth has no zero"):
        make_reference_record(recording, "zn")


def test_close_ends_all_threads(tmp_path, make_rig):
    rig = make_rig(tmp_path)
    rig.microscope.start()
    rig.microscope.close()
    names = {thread.name for thread in threading.enumerate()}
    assert not names & {"microscope", "tip tracking", "cameras"}


@pytest.mark.slow
def test_nano_stage_lands_within_half_a_pixel_near_the_edge_of_a_cell(tmp_path, make_rig):
    """In the usual order. The area uncovered during the calibration becomes the background."""
    rig = make_rig(tmp_path)
    rig.find_cameras()
    for stage in ("micro", "nano"):
        status = calibrate(rig, stage)
    assert status.tip.state is TipState.TRACKED
    cell = rig.feed.camera.scene.cell
    cell_centre = rig.optics.pixel_of(np.array(cell.centre_m))
    rng = np.random.default_rng(3)
    stages = []
    for angle in rng.uniform(0.0, 2.0 * np.pi, 4):
        # A point near the edge of the cell.
        goal = cell_centre + 60.0 * np.array([np.cos(angle), np.sin(angle)])
        stages.append(rig.microscope.plan(goal).stage)
        go_and_arrive(rig, goal)
    assert stages.count("nano") >= 2


@pytest.mark.slow
def test_full_size_calibration_and_clicks_land_within_half_a_pixel(tmp_path, make_rig):
    """The acceptance test: full size, hidden mounting, and only the robot is known beforehand."""
    mounting = {"rotation_rad": -1.9, "mirrored": True, "skew_rad": 0.015, "pixel_m": 0.341e-6}
    rig = make_rig(tmp_path, mounting)
    rig.find_cameras()
    true_geometry = StageMap(rig.optics.mapping[:, :2], np.zeros((4, 4))).geometry
    for stage in ("micro", "nano"):
        status = calibrate(rig, stage)
        measured = status.calibration.get_stage(stage).map.geometry
        assert measured.handedness == true_geometry.handedness
        assert measured.pixel_size == pytest.approx(true_geometry.pixel_size, rel=1e-3)
        assert np.degrees(measured.rotation) == pytest.approx(
            np.degrees(true_geometry.rotation), abs=0.05
        )
        assert np.degrees(measured.skew) == pytest.approx(np.degrees(true_geometry.skew), abs=0.05)
    rig.start_tracking()
    for goal in ((250.4, 300.7), (1000.0, 800.3), (980.0, 810.0)):
        rig.microscope.plan(np.array(goal))
        go_and_arrive(rig, goal)
