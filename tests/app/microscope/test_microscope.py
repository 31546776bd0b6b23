"""The whole microscope over a simulated machine: what a panel can ask, and what ends it."""

import dataclasses
import threading

import numpy as np
import pytest

from rotemina.app.cameras.feed import FeedState
from rotemina.app.microscope.calibration_run import Phase
from rotemina.app.microscope.camera_in_use import CameraInUse
from rotemina.app.microscope.click_corrections import Visit
from rotemina.app.microscope.errors import MicroscopeError
from rotemina.app.microscope.focus_run import Search
from rotemina.app.microscope.recorded_reference import recorded_reference
from rotemina.app.microscope.status import Activity, ScaleSource, TipState
from rotemina.app.motion.mailbox import RefusedError
from rotemina.app.motion.penetration.status import Phase as PenetrationPhase
from rotemina.app.motion.recording.recording_reader import Recording
from rotemina.app.motion.recording.session_recorder import SessionRecorder
from rotemina.drivers.cameras.hub import CameraHub
from rotemina.drivers.cameras.simulated import SimulatedMicroscope
from rotemina.sim.records.record import Tap
from rotemina.sim.vision.calibration import StageMap


def still(work):
    """Tell whether nothing moves from now on."""
    before = dict(work.session.snapshot().command)
    work.step(8)
    return work.session.snapshot().command == before


def test_nothing_is_opened_before_somebody_looks_and_then_by_itself(tmp_path, make_work):
    work = make_work(tmp_path)
    work.step(3)
    assert work.feed is None
    assert work.microscope.status.feed.frame is None
    work.step(3)
    status = work.microscope.status
    assert status.camera.key == "simulated:microscope"
    assert status.feed.frame is not None
    assert status.scale_source is ScaleSource.ROBOT_FILE
    work.microscope.camera.close_and_forget()
    work.step(40)
    assert work.microscope.status.camera is None  # who closed it wants none


def test_another_machine_than_the_simulated_is_said_in_words():
    class Board:
        name = "MC68HC11 board"

    source = SimulatedMicroscope(Board)
    used = CameraInUse(CameraHub({"simulated": source}), Board)
    used.watched = True
    used.step(0.0)
    assert used.camera is None
    assert "MC68HC11 board shows only a simulated machine" in used.truth
    with pytest.raises(MicroscopeError, match="there is no camera"):
        used.open("simulated:microscope")


def test_the_tip_is_found_in_whatever_direction_and_pictures_are_passed_over(work):
    work.microscope.track(True)
    work.step(2)
    for _ in range(4):
        work.clock.advance(0.05)
        work.feed.grab()
    work.microscope.step(work.clock())
    status = work.microscope.status
    assert status.tip.state is TipState.TRACKED
    assert status.tip.pixel == pytest.approx(work.true_pixel(), abs=0.2)
    assert status.tip.place_m == pytest.approx(work.true_tip()[:2], abs=0.1e-6)
    assert 0.0 < status.tip.sigma_px < 0.2
    assert status.frames_processed == 3
    assert status.frames_skipped >= 3
    work.microscope.track(False)
    work.step()
    assert work.microscope.status.tip.state is TipState.OFF


def test_a_click_lands_and_one_run_is_allowed_at_a_time(work):
    work.tracking()
    goal = work.true_pixel() + np.array([60.0, -40.0])
    move = work.microscope.plan(goal)
    assert work.microscope.status.planned.ghost == pytest.approx(goal, abs=0.1)
    assert still(work)
    assert not move.confirm
    work.microscope.go()
    with pytest.raises(MicroscopeError, match="click is under way"):
        work.microscope.calibrate("micro")
    with pytest.raises(MicroscopeError, match="click is under way"):
        work.microscope.choose_objective("40x")
    status = work.until(lambda status: status.activity is Activity.NONE)
    assert status.visiting.visit is Visit.ARRIVED, status.visiting.reason
    assert work.true_pixel() == pytest.approx(goal, abs=0.5)
    assert status.path is not None
    assert np.ptp(status.nano_limits, axis=0).min() > 50.0
    with pytest.raises(MicroscopeError, match="no move is planned"):
        work.microscope.go()


def test_a_click_is_planned_from_where_the_tip_is_and_not_from_an_old_picture(work):
    work.tracking()
    at = work.session.snapshot().command
    work.session.go_to({"x": at["x"] + 20e-6, "y": at["y"] - 15e-6})
    for _ in range(40):  # the camera's pictures are late: none is looked at
        work.clock.advance(0.05)
        work.session.run_once()
    assert not work.session.snapshot().queued
    seen = work.microscope.status.tip.pixel
    assert np.linalg.norm(work.true_pixel() - seen) > 50.0
    goal = work.true_pixel() + np.array([30.0, 20.0])
    work.microscope.plan(goal)
    work.microscope.go()
    status = work.until(lambda status: status.activity is Activity.NONE)
    assert status.visiting.visit is Visit.ARRIVED, status.visiting.reason
    assert work.true_pixel() == pytest.approx(goal, abs=0.5)


def test_a_click_wants_the_tip_tracked_and_a_far_one_confirmed(work):
    work.microscope.plan(work.true_pixel() + 20.0)
    with pytest.raises(MicroscopeError, match="not tracked"):
        work.microscope.go()
    work.tracking()
    work.microscope.plan(np.array([600.0, 60.0]))
    with pytest.raises(MicroscopeError, match="confirm"):
        work.microscope.go()
    assert work.microscope.status.activity is Activity.NONE
    work.microscope.mark_target(np.array([600.0, 60.0]))
    with pytest.raises(MicroscopeError, match="confirm"):
        work.microscope.visit_next()
    assert still(work)


def frozen(work):
    kept = work.feed.newest.pixels
    work.feed.spoil = lambda frame: dataclasses.replace(frame, pixels=kept)
    work.step(16)  # it takes a second until the same picture counts as frozen


def test_a_tip_in_a_picture_that_is_no_longer_new_is_lost_until_the_next_new_one(work):
    work.tracking()
    frozen(work)
    seen = work.microscope.status
    assert (seen.feed.state, seen.tip.state) == (FeedState.FROZEN, TipState.LOST)
    assert "the camera is frozen" in seen.tip.reason
    work.feed.spoil = lambda frame: frame
    work.step(2)
    assert work.microscope.status.tip.state is TipState.TRACKED


def black(work):
    work.feed.spoil = lambda frame: dataclasses.replace(frame, pixels=frame.pixels * np.uint16(0))


def lost(work):
    work.feed.lose("was unplugged")


@pytest.mark.parametrize(
    ("spoil", "told"), [(frozen, "frozen"), (black, "black"), (lost, "unplugged")]
)
def test_a_camera_that_cannot_be_trusted_ends_what_moves_by_it(work, spoil, told):
    work.tracking()
    work.microscope.calibrate("micro")
    work.step(6)
    assert work.microscope.status.activity is Activity.CALIBRATION
    spoil(work)
    work.step(2)
    status = work.microscope.status
    assert status.activity is Activity.NONE
    assert status.calibrating.phase is Phase.FAILED
    assert told in status.calibrating.reason
    work.step(5)
    assert still(work)
    with pytest.raises(MicroscopeError, match=told):
        work.microscope.calibrate("micro")


@pytest.mark.slow
def test_a_lost_tip_ends_a_click(work):
    work.tracking()
    work.microscope.plan(work.true_pixel() + np.array([250.0, 0.0]))
    work.microscope.go(confirmed=True)
    work.feed.camera.move_focus(450e-6)
    status = work.until(lambda status: status.activity is Activity.NONE)
    assert status.visiting.visit is Visit.FAILED
    assert "tip is" in status.visiting.reason
    work.step(5)
    assert still(work)


def test_a_stop_since_the_wish_ends_a_click_and_a_visit_of_a_target(work):
    """A yes that was said before the stop, and arrives after it, moves nothing."""
    work.tracking()
    place = work.true_pixel() + np.array([20.0, 0.0])
    microscope, session = work.microscope, work.microscope.session
    microscope.mark_target(place)
    for go in (microscope.go, microscope.visit_next):
        microscope.plan(place)
        permit = session.permit()
        session.stop()
        with pytest.raises(RefusedError, match="try again"):
            go(confirmed=True, permit=permit)
        work.step(2)
        assert still(work)


def test_stop_ends_a_calibration_where_it_is(work):
    work.tracking()
    work.microscope.calibrate("nano")
    work.step(8)
    work.microscope.stop()
    work.step(2)
    status = work.microscope.status
    assert status.activity is Activity.NONE
    assert status.stopped == "stopped"
    assert still(work)


@pytest.mark.slow
def test_what_the_autofocus_found_is_kept_for_the_next_start(work, tmp_path, make_work):
    work.tracking()
    work.microscope.adjustments.autofocus()
    status = work.until(lambda status: status.activity is Activity.NONE)
    assert status.focusing.search is Search.DONE, status.focusing.reason
    assert 0.0 < status.calibration.focus.uncertainty < 1e-6
    # The body climbs from the tip away: what is sharpest about it lies a little higher.
    assert abs(status.calibration.focus.sharpest) < 6e-6
    again = make_work(tmp_path)
    again.look()
    assert again.microscope.status.calibration == status.calibration
    again.microscope.choose_objective("40x")
    again.step()
    assert again.microscope.status.calibration is None
    assert again.microscope.status.pixel_m == pytest.approx(0.1675e-6)
    with pytest.raises(MicroscopeError, match="'axes' cannot focus"):
        again.microscope.adjustments.autofocus("axes")


def test_targets_are_visited_one_after_the_other(work):
    work.tracking()
    here, cell = work.true_pixel(), work.feed.camera.scene.cell
    aside = here - work.optics.pixel_of(np.array(cell.centre_m))
    aside /= np.linalg.norm(aside)
    for away in (40.0, 80.0):
        work.microscope.mark_target(here + away * aside)
    work.microscope.mark_target(here)
    work.microscope.positioning.sequence.remove(2)
    for away in (40.0, 80.0):
        work.microscope.visit_next()
        with pytest.raises(MicroscopeError, match="moving to a target"):
            work.microscope.positioning.sequence.clear()
        status = work.until(lambda status: status.activity is Activity.NONE)
        assert work.true_pixel() == pytest.approx(here + away * aside, abs=0.5)
    assert [one.visit for one in status.targets] == [Visit.ARRIVED, Visit.ARRIVED]
    with pytest.raises(MicroscopeError, match="every target"):
        work.microscope.visit_next()


def test_cell_line_and_drift(work):
    work.tracking()
    cell = work.feed.camera.scene.cell
    middle = work.optics.pixel_of(np.array(cell.centre_m))
    work.microscope.outline_cell(middle + 8.0)
    work.microscope.measure(middle, work.true_pixel())
    work.microscope.jobs.watch_drift(True)
    work.step(3)
    status = work.microscope.status
    assert status.cell.outline.centre == pytest.approx(middle, abs=1.0)
    away = np.linalg.norm(work.true_pixel() - middle) * 0.33e-6
    assert status.measured.length_m == pytest.approx(away, rel=0.03)
    assert status.drift.watched
    work.microscope.outline_cell(np.array([20.0, 20.0]))
    work.step()
    assert work.microscope.status.cell.outline is None
    assert work.microscope.status.cell.reason


def test_while_a_penetration_is_armed_the_body_is_learnt(tmp_path, make_work):
    phase = [PenetrationPhase.DISARMED]
    work = make_work(tmp_path, penetration=lambda: phase[0])
    work.look()
    work.tracking()
    for phase[0], learnt, dimple in (
        (PenetrationPhase.ARMED, 3, False),
        (PenetrationPhase.THRUST, 3, True),
        (PenetrationPhase.DONE, 0, False),
    ):
        work.step(3)
        track = work.microscope.tracker.tracked.track
        assert (track.learnt, track.dimple) == (learnt, dimple)
        assert track.pixel == pytest.approx(work.true_pixel(), abs=1.5)


def test_pictures_become_the_reference_of_a_record(tmp_path, make_work):
    """From frames through a recording to a record whose ``ref`` is the true place."""
    running = []
    work = make_work(tmp_path, seconds=0.04, recorder=lambda: running[0] if running else None)
    work.look()
    work.calibrate_by_truth()
    work.tracking()
    recorder = SessionRecorder(work.session, tmp_path / "run.arrows", clock=work.clock)
    recorder.start(thread=False)
    running.append(recorder)
    begin = work.session.snapshot().command["x"]
    truth = []
    for step in range(36):
        if step == 10:
            work.session.go_to({"x": begin + 30e-6}, speeds={"x": 40e-6})
        work.step()
        frame = work.microscope.tracker.tracked.frame
        truth.append((frame.host_time_s, work.driver.true_positions[0]))
    recorder.writer.run_once()
    recorder.close()
    recording = Recording.open(tmp_path / "run.arrows")
    frames = recording.channel("frames")
    assert np.all(np.diff(frames["number"]) >= 1.0)
    assert np.array_equal(recording.channel("tip")["frame"], frames["number"])
    record = recorded_reference(recording, "x")
    seen = record.signal("x", Tap.REF)
    times, places = np.array(truth).T
    samples = recording.samples()
    at_s = np.interp(record.time_s, samples.device_time_s - samples.device_time_s[0],
                     samples.host_time_s)  # fmt: skip
    assert seen == pytest.approx(np.interp(at_s, times, places), abs=0.1e-6)
    assert np.ptp(seen) == pytest.approx(30e-6, rel=0.01)
    with pytest.raises(MicroscopeError, match="depth has no zero"):
        recorded_reference(recording, "zn")


def test_close_lets_go_of_everything(tmp_path, make_work):
    work = make_work(tmp_path)
    work.microscope.start()
    work.microscope.close()
    names = {thread.name for thread in threading.enumerate()}
    assert not names & {"microscope", "tip tracking", "cameras"}


@pytest.mark.slow
def test_over_the_edge_of_a_cell_the_nano_stage_lands_within_half_a_pixel(tmp_path, make_work):
    """In the usual order: what the tip uncovers while it is calibrated becomes the background."""
    work = make_work(tmp_path)
    work.look()
    for stage in ("micro", "nano"):
        work.microscope.calibrate(stage)
        status = work.until(lambda status: status.activity is Activity.NONE)
        assert status.calibrating.phase is Phase.DONE, status.calibrating.reason
    assert status.tip.state is TipState.TRACKED
    cell = work.feed.camera.scene.cell
    middle = work.optics.pixel_of(np.array(cell.centre_m))
    rng = np.random.default_rng(3)
    stages = []
    for angle in rng.uniform(0.0, 2.0 * np.pi, 8):
        goal = middle + 60.0 * np.array([np.cos(angle), np.sin(angle)])  # about where it ends
        stages.append(work.microscope.plan(goal).stage)
        work.microscope.go(confirmed=True)
        status = work.until(lambda status: status.activity is Activity.NONE)
        assert status.visiting.visit is Visit.ARRIVED, status.visiting.reason
        assert np.linalg.norm(work.true_pixel() - goal) < 0.5
    assert stages.count("nano") >= 5


@pytest.mark.slow
def test_the_whole_picture_is_calibrated_and_a_click_lands_within_half_a_pixel(tmp_path, make_work):
    """The acceptance: full size, a hidden mounting, nothing known beforehand but the robot."""
    mounting = {"rotation_rad": -1.9, "mirrored": True, "skew_rad": 0.015, "pixel_m": 0.341e-6}
    work = make_work(tmp_path, mounting)
    work.look()
    true = StageMap(work.optics.mapping[:, :2], np.zeros((4, 4))).geometry
    for stage in ("micro", "nano"):
        work.microscope.calibrate(stage)
        status = work.until(lambda status: status.activity is Activity.NONE)
        assert status.calibrating.phase is Phase.DONE, status.calibrating.reason
        told = status.calibration.stage(stage).map.geometry
        assert told.handedness == true.handedness
        assert told.pixel_size == pytest.approx(true.pixel_size, rel=1e-3)
        assert np.degrees(told.rotation) == pytest.approx(np.degrees(true.rotation), abs=0.05)
        assert np.degrees(told.skew) == pytest.approx(np.degrees(true.skew), abs=0.05)
    work.tracking()
    for goal in ((250.4, 300.7), (1000.0, 800.3), (700.2, 500.0), (680.0, 510.0)):
        work.microscope.plan(np.array(goal))
        work.microscope.go(confirmed=True)
        status = work.until(lambda status: status.activity is Activity.NONE)
        assert status.visiting.visit is Visit.ARRIVED, status.visiting.reason
        assert np.linalg.norm(work.true_pixel() - goal) < 0.5
