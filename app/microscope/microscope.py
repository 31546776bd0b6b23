"""Facade of the microscope services: camera, calibration, clicks and vision."""

import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

from rotemina.app.cameras import CameraFeed
from rotemina.app.errors import MicroscopeError
from rotemina.app.microscope.adjustments import FOCUS_DRIVE, MicroscopeProcedures
from rotemina.app.microscope.camera_in_use import CameraInUse
from rotemina.app.microscope.camera_memory import CameraMemory
from rotemina.app.microscope.click_target import PlannedMove
from rotemina.app.microscope.frame_recording import FrameRecorder
from rotemina.app.microscope.measurements import compute_tip_xy
from rotemina.app.microscope.optical_setup import OpticalSetup
from rotemina.app.microscope.picture_jobs import PictureJobs
from rotemina.app.microscope.runs import MicroscopeRunner
from rotemina.app.microscope.status import (
    CellStatus,
    MeasuredLine,
    MicroscopeActivity,
    MicroscopeStatus,
    TipState,
    TipStatus,
)
from rotemina.app.microscope.tip_positioning import TipPositioning
from rotemina.app.microscope.tip_tracker import TipContact, TipTracker, TrackingResult
from rotemina.app.motion.device import Ticker
from rotemina.app.motion.penetration import PenetrationPhase
from rotemina.app.motion.recording import SessionRecorder
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import PROGRAM
from rotemina.app.settings import UserSettings
from rotemina.drivers.cameras import Camera, CameraHub, SimulatedMicroscope
from rotemina.drivers.contract import Clock, Permit
from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import marked, message
from rotemina.sim.vision import TipTrack, find_membrane_ahead

# Folder of the calibrations in the user's folder.
CALIBRATION_FOLDER = "microscope"
RUN_PERIOD_S, TRACK_PERIOD_S, MAINTENANCE_PERIOD_S = 0.02, 0.008, 0.1
_ARMED_PHASES = (PenetrationPhase.ARMED,)
_RESTING_PHASES = (
    PenetrationPhase.DISARMED,
    PenetrationPhase.DONE,
    PenetrationPhase.ABORTED,
    PenetrationPhase.FAILED,
)


class Microscope:
    """The microscope, for views and scripts.

    Every method may be called from any thread and never waits, except :meth:`close`, :meth:`step`
    and :meth:`maintain`. A method raises InputError if it can refuse the request at once; later
    problems appear in :attr:`status`.

    Parameters
    ----------
    session : MotionSession
    folder : Path
        Folder of the user's files; it contains the folder of the calibrations.
    hub : CameraHub, optional
        Finds and opens cameras; by default the installed ones and the simulated microscope.
    get_recorder : callable
        Returns the running recorder, or None.
    read_penetration_phase : callable
        Returns the phase of the penetration.
    clock : callable
        Clock of the host, which the session and the cameras use too.
    notify : callable
        Called on any thread with a message for the operator that :attr:`status` does not show.
    make_feed : callable
        Makes the feed of a camera.
    settings : UserSettings, optional
        Preferences, in which the camera in use is remembered for the next start.
    """

    def __init__(
        self,
        session: MotionSession,
        folder: Path,
        *,
        hub: CameraHub | None = None,
        get_recorder: Callable[[], SessionRecorder | None] = lambda: None,
        read_penetration_phase: Callable[[], PenetrationPhase] = lambda: PenetrationPhase.DISARMED,
        clock: Clock = time.monotonic,
        notify: Callable[[str], None] = lambda _: None,
        make_feed: Callable[[Camera], CameraFeed] | None = None,
        settings: UserSettings | None = None,
    ) -> None:
        self.session, self.clock = session, clock
        self._read_penetration_phase, self._notify = read_penetration_phase, notify
        simulated = SimulatedMicroscope(lambda: session.driver, clock=clock)
        hub = CameraHub.from_plugins({"simulated": simulated}, clock=clock) if hub is None else hub
        make_camera_feed = make_feed or (lambda camera: CameraFeed(camera, clock=clock))
        memory = CameraMemory(settings)
        self.camera = CameraInUse(
            hub, lambda: session.driver, make_camera_feed, memory, lambda: self._refuse_during_run()
        )
        self.setup = OpticalSetup(session, folder / CALIBRATION_FOLDER, lambda: self.camera.camera)
        self.recording = FrameRecorder(get_recorder, lambda: self.setup.calibration)
        self.tracker = TipTracker(
            lambda: self.camera.view,
            self.setup.make_pipette,
            self.setup.predict_tip_pixel,
            self._read_tip_contact,
            self.recording.record_tip,
        )
        self.picture_jobs = PictureJobs(lambda: self.camera.newest_frame)
        self.runner = MicroscopeRunner(
            session,
            lambda: self.camera.view,
            lambda activity: self.positioning.find_tracking_problem(activity),
        )
        self.positioning = TipPositioning(
            session, self.camera, self.setup, self.tracker, self.runner, clock
        )
        self.procedures = MicroscopeProcedures(
            session, self.camera, self.setup, self.tracker, self.runner, clock, notify
        )
        #: Both ends (2,), px, of the measured line.
        self.line_ends: tuple[FloatArray, FloatArray] | None = None
        self._stop_listening = self.camera.listen(self.recording.record_frame)
        self._tickers = (
            Ticker(
                "microscope",
                RUN_PERIOD_S,
                lambda: self.runner.step(self.clock()),
                self._report_failure,
            ),
            Ticker("tip tracking", TRACK_PERIOD_S, self.tracker.step, self._report_failure),
            Ticker(
                "cameras",
                MAINTENANCE_PERIOD_S,
                lambda: self.maintain(self.clock()),
                self._report_failure,
            ),
        )

    def start(self) -> None:
        """Start the threads that search for cameras, track the tip and advance the runs."""
        for ticker in self._tickers:
            ticker.start()

    def close(self) -> None:
        """Stop the current run and all threads, and release the camera."""
        self.runner.stop(marked("engine", "the program is being closed"))
        for ticker in self._tickers:
            ticker.close()
        self._stop_listening()
        self.camera.close()

    def step(self, now_s: float) -> None:
        """Do the work of all threads once; for tests."""
        self.maintain(now_s)
        self.tracker.step()
        self.runner.step(now_s)

    def maintain(self, now_s: float) -> None:
        """Update cameras and calibrations, and run slow picture jobs; may take a while."""
        self.camera.step(now_s)
        self.setup.step()
        self.picture_jobs.step(now_s)
        track = self.tracker.result.track
        if track is not None:
            self.setup.store_direction(track.pipette.direction)

    @property
    def status(self) -> MicroscopeStatus:
        """The current state for a view; read it once per frame while the view is visible.

        The first read starts the search for cameras.
        """
        self.camera.is_watched = True
        setup, tracking = self.setup, self.tracker.result
        feed_view, camera = self.camera.view, self.camera.camera
        pixel_m, source = setup.scale
        positioning, procedures = self.positioning, self.procedures
        calibration_run, focus_run = procedures.calibration_run, procedures.focus_run
        tip = self.tracker.tip
        return MicroscopeStatus(
            cameras=self.camera.cameras,
            camera_problems=self.camera.problems,
            camera=None if camera is None else camera.identity,
            feed=feed_view,
            objective=setup.objective,
            objectives=setup.objectives,
            calibration=setup.calibration,
            calibration_problem=setup.problem,
            pixel_m=pixel_m,
            scale_source=source,
            activity=self.runner.activity,
            calibration_status=None if calibration_run is None else calibration_run.status,
            visit_status=None if positioning.visit_run is None else positioning.visit_run.status,
            focus_status=None if focus_run is None else focus_run.status,
            stack_status=None if procedures.stack_run is None else procedures.stack_run.status,
            abort_reason=self.runner.abort_reason,
            planned_move=positioning.planned_move,
            tip_path=self.tracker.path,
            tip=_make_tip_status(setup, tracking),
            cell=_make_cell_status(self.picture_jobs, tip, pixel_m),
            measured_line=_make_measured_line(self.line_ends, tip, pixel_m),
            targets=tuple(positioning.target_sequence.targets),
            nano_limits=setup.compute_nano_limits(None if tip is None else tip.pixel),
            focus_axes=procedures.focus_axes,
            drift=self.picture_jobs.drift,
            has_background=tracking.has_background,
            frames_processed=tracking.processed,
            frames_skipped=tracking.skipped,
            simulation_problem=self.camera.simulation_problem,
        )

    def choose_objective(self, name: str) -> None:
        """Set the objective; raises MicroscopeError if the name is empty, or during a run."""
        self._refuse_during_run()
        self.positioning.planned_move = None
        self.setup.choose_objective(name)

    def calibrate(self, stage: str, *, whole_picture: bool = False) -> None:
        """Start the guided calibration of ``micro`` or ``nano``, and tracking of the tip.

        By default, the calibration assumes that only the tip moves, in front of a stationary
        background. With ``whole_picture`` it assumes that the whole picture moves with the stage,
        and the tip is not tracked.

        Raises
        ------
        InputError
            See :class:`StageCalibrationRun` and :meth:`MicroscopeRunner.begin`. In that case
            nothing has moved.
        """
        self.procedures.calibrate(stage, whole_picture=whole_picture)
        if not whole_picture and self.tracker.result.state is TipState.OFF:
            # The moves of the calibration uncover the background, which the tracker then collects.
            self.tracker.switch(True)

    def move_focus(self, focus_m: float) -> None:
        """Move the microscope's focus drive to a position, m.

        Raises
        ------
        InputError
            If there is no focus drive, the drive refuses the move, or a run is under way.
        """
        self._refuse_during_run()
        self.procedures.make_focus_mover(FOCUS_DRIVE)(focus_m, None)

    def plan(self, pixel: FloatArray, *, stage: str | None = None) -> PlannedMove:
        """Plan the move that a click or a drag requests, for a preview; nothing moves.

        Raises
        ------
        InputError
            See :meth:`ClickMover.plan`.
        """
        return self.positioning.plan(pixel, stage)

    def cancel_plan(self) -> None:
        """Discard the planned move."""
        self.positioning.planned_move = None

    def go(self, *, confirmed: bool = False, permit: Permit | None = None) -> None:
        """Make the planned move, and correct it until the tip is at the goal.

        If the request waited for a confirmation, pass the ``permit`` that was issued when the
        operator made it. By default a new permit is issued.

        Raises
        ------
        MicroscopeError
            If no move is planned, the tip is not tracked, or a large move is not confirmed.
        InputError
            See :meth:`ClickMover.go` and :meth:`MicroscopeRunner.begin`.
        """
        self.positioning.go(confirmed=confirmed, permit=permit or self.session.permit())

    def go_back(self) -> None:
        """Return to the position before the latest move.

        Raises
        ------
        MicroscopeError
            If a run is under way.
        InputError
            See :meth:`MotionSession.undo`.
        """
        self._refuse_during_run()
        self.session.undo()

    def stop(self, *, by: str = PROGRAM) -> None:
        """Halt the machine, and end the current run; ``by`` as in :meth:`MotionSession.stop`."""
        self.runner.stop(message("engine", "stopped"), by=by)
        self.session.stop(by=by)

    def mark_target(self, pixel: FloatArray) -> None:
        """Add a target at the end of the list."""
        self.positioning.target_sequence.mark(np.asarray(pixel, dtype=np.float64))

    def visit_next(self, *, confirmed: bool = False, permit: Permit | None = None) -> None:
        """Move to the next target; ``permit`` as in :meth:`go`.

        Raises
        ------
        MicroscopeError
            If no target is left, or the move is so large that it needs a confirmation.
        InputError
            See :meth:`go`.
        """
        self.positioning.visit_next(confirmed=confirmed, permit=permit or self.session.permit())

    def track(self, on: bool, *, near: FloatArray | None = None) -> None:
        """Turn tracking on or off; ``near`` (2,), px, is the approximate position of the tip."""
        self.tracker.switch(on, near)

    def outline_cell(self, near: FloatArray) -> None:
        """Request the outline of the cell around ``near`` (2,), px."""
        self.picture_jobs.request_outline(np.asarray(near, dtype=np.float64), self.setup.pixel_m)

    def measure(self, begin: FloatArray, end: FloatArray) -> None:
        """Measure the line from one pixel (2,) to another."""
        ends = np.asarray(begin, dtype=np.float64), np.asarray(end, dtype=np.float64)
        if not (np.isfinite(ends[0]).all() and np.isfinite(ends[1]).all()):
            raise MicroscopeError("measure: a pixel is not a finite number; draw the line again")
        self.line_ends = ends

    def clear_measurement(self) -> None:
        """Remove the measured line."""
        self.line_ends = None

    def _read_tip_contact(self) -> TipContact:
        phase = self._read_penetration_phase()
        if phase in _ARMED_PHASES:
            return TipContact.SOON
        return TipContact.NO if phase in _RESTING_PHASES else TipContact.YES

    def _refuse_during_run(self) -> None:
        if self.runner.activity is not MicroscopeActivity.NONE:
            raise MicroscopeError(
                "{activity} is under way; wait, or stop it first", activity=self.runner.activity
            )

    def _report_failure(self, _: Exception) -> None:
        self._notify(
            message(
                "engine",
                "A step of the microscope failed; the log has the cause. If this repeats, open "
                "the camera again",
            )
        )


def _make_tip_status(setup: OpticalSetup, tracking: TrackingResult) -> TipStatus:
    track = tracking.track
    if track is None:
        return TipStatus(tracking.state, reason=tracking.reason)
    position_m = sigma_m = None
    calibration = setup.calibration
    if calibration is not None and calibration.micro is not None:
        position_m, covariance = compute_tip_xy(track.pixel, track.covariance, calibration.micro)
        sigma_m = np.sqrt(np.diag(covariance))
    return TipStatus(
        state=tracking.state,
        pixel=track.pixel,
        sigma_px=float(np.sqrt(np.linalg.eigvalsh(track.covariance)[-1])),
        direction=track.pipette.direction,
        depth=track.depth,
        position_m=position_m,
        sigma_m=sigma_m,
        quality=track.quality,
        reason=tracking.reason,
    )


def _make_cell_status(jobs: PictureJobs, tip: TipTrack | None, pixel_m: float | None) -> CellStatus:
    outline, reason = jobs.cell_outline, jobs.outline_reason
    if outline is None or tip is None:
        return CellStatus(outline, reason=reason)
    # ``pipette.direction`` points from the tip to the body, so the tip points the opposite way.
    membrane_ahead = find_membrane_ahead(
        outline, tip.pixel, tip.covariance, tip.pipette.direction + np.pi
    )
    if membrane_ahead is None or pixel_m is None:
        return CellStatus(outline, membrane_ahead, reason=reason)
    distance_m, sigma_m = (
        membrane_ahead.distance * pixel_m,
        membrane_ahead.distance_uncertainty * pixel_m,
    )
    return CellStatus(outline, membrane_ahead, distance_m, sigma_m, reason)


def _make_measured_line(
    ends: tuple[FloatArray, FloatArray] | None, tip: TipTrack | None, pixel_m: float | None
) -> MeasuredLine | None:
    if ends is None:
        return None
    vector = ends[1] - ends[0]
    length, angle = float(np.hypot(*vector)), float(np.arctan2(vector[1], vector[0]))
    angle_to_pipette = None
    if tip is not None:
        difference = (angle - tip.pipette.direction + 0.5 * np.pi) % np.pi - 0.5 * np.pi
        angle_to_pipette = float(abs(difference))
    return MeasuredLine(
        begin=ends[0],
        end=ends[1],
        length_px=length,
        length_m=None if pixel_m is None else length * pixel_m,
        angle=angle,
        angle_to_pipette=angle_to_pipette,
    )
