"""The microscope in use: one facade for camera, calibration, clicks and vision."""

import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

from rotemina.app.cameras.feed import CameraFeed
from rotemina.app.microscope.adjustments import FOCUS, Adjustments
from rotemina.app.microscope.camera_in_use import CameraInUse
from rotemina.app.microscope.camera_memory import CameraMemory
from rotemina.app.microscope.click_target import PlannedMove
from rotemina.app.microscope.errors import MicroscopeError
from rotemina.app.microscope.frame_recording import FrameRecording
from rotemina.app.microscope.measurements import tip_in_plane
from rotemina.app.microscope.optical_setup import OpticalSetup
from rotemina.app.microscope.picture_jobs import PictureJobs
from rotemina.app.microscope.runs import Runs
from rotemina.app.microscope.status import (
    Activity,
    CellSeen,
    Measured,
    MicroscopeStatus,
    TipSeen,
    TipState,
)
from rotemina.app.microscope.tip_positioning import TipPositioning
from rotemina.app.microscope.tip_tracker import Pressing, TipTracker, Tracked
from rotemina.app.motion.penetration.status import Phase as PenetrationPhase
from rotemina.app.motion.recording.session_recorder import SessionRecorder
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.stop import PROGRAM
from rotemina.app.motion.ticker import Ticker
from rotemina.app.settings import Settings
from rotemina.drivers.cameras.camera import Camera
from rotemina.drivers.cameras.hub import CameraHub
from rotemina.drivers.cameras.simulated import SimulatedMicroscope
from rotemina.drivers.clock import Clock
from rotemina.drivers.gate import Permit
from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import marked, message
from rotemina.sim.vision.cell import membrane_ahead
from rotemina.sim.vision.tracking import TipTrack

FOLDER = "microscope"  # of calibrations, in the user's own
RUN_S, TRACK_S, KEEP_S = 0.02, 0.008, 0.1
_ARMED = (PenetrationPhase.ARMED,)
_AT_REST = (
    PenetrationPhase.DISARMED,
    PenetrationPhase.DONE,
    PenetrationPhase.ABORTED,
    PenetrationPhase.FAILED,
)


class Microscope:
    """What a panel holds; every method may be called from any thread and never waits.

    A method raises InputError where what is asked can be refused at once; what goes wrong later is
    in :attr:`status`.

    Parameters
    ----------
    session : MotionSession
    folder : Path
        Of the user's files; calibrations are in a folder of it.
    hub : CameraHub, optional
        Of all cameras; by default the installed ones and the simulated microscope.
    recorder : callable
        Return what records now, or None.
    penetration : callable
        Return the phase of the penetration.
    clock : callable
        The host's; the session's and the cameras' too.
    told : callable
        Gets what the operator must know and no state shows, on any thread.
    feed_of : callable
        Make the feed of a camera.
    settings : Settings, optional
        Where the camera in use is remembered for the next start.
    """

    def __init__(
        self,
        session: MotionSession,
        folder: Path,
        *,
        hub: CameraHub | None = None,
        recorder: Callable[[], SessionRecorder | None] = lambda: None,
        penetration: Callable[[], PenetrationPhase] = lambda: PenetrationPhase.DISARMED,
        clock: Clock = time.monotonic,
        told: Callable[[str], None] = lambda _: None,
        feed_of: Callable[[Camera], CameraFeed] | None = None,
        settings: Settings | None = None,
    ) -> None:
        self.session, self.clock = session, clock
        self._penetration, self._told = penetration, told
        simulated = SimulatedMicroscope(lambda: session.driver, clock=clock)
        hub = CameraHub.installed({"simulated": simulated}, clock=clock) if hub is None else hub
        made = feed_of or (lambda camera: CameraFeed(camera, clock=clock))
        memory = CameraMemory(settings)
        self.camera = CameraInUse(
            hub, lambda: session.driver, made, memory, lambda: self._refuse_under_way()
        )
        self.setup = OpticalSetup(session, folder / FOLDER, lambda: self.camera.camera)
        self.recording = FrameRecording(recorder, lambda: self.setup.calibration)
        self.tracker = TipTracker(
            lambda: self.camera.view,
            self.setup.pipette,
            self.setup.expected,
            self._pressing,
            self.recording.tip,
        )
        self.jobs = PictureJobs(lambda: self.camera.newest)
        self.runs = Runs(
            session, lambda: self.camera.view, lambda what: self.positioning.doubt(what)
        )
        self.positioning = TipPositioning(
            session, self.camera, self.setup, self.tracker, self.runs, clock
        )
        self.adjustments = Adjustments(
            session, self.camera, self.setup, self.tracker, self.runs, clock, told
        )
        #: Ends (2,), px, of the measured line.
        self.measured: tuple[FloatArray, FloatArray] | None = None
        self._leave = self.camera.listen(self.recording.frame)
        self._tickers = (
            Ticker("microscope", RUN_S, lambda: self.runs.step(self.clock()), self._failed),
            Ticker("tip tracking", TRACK_S, self.tracker.step, self._failed),
            Ticker("cameras", KEEP_S, lambda: self.keep(self.clock()), self._failed),
        )

    # --- life -------------------------------------------------------------------------------------

    def start(self) -> None:
        """Look for cameras and begin to work, on threads of its own."""
        for ticker in self._tickers:
            ticker.start()

    def close(self) -> None:
        """End what is under way, and release the camera."""
        self.runs.stop(marked("engine", "the program is being closed"))
        for ticker in self._tickers:
            ticker.close()
        self._leave()
        self.camera.close()

    def step(self, now_s: float) -> None:
        """Do all that the threads do, once; for a test."""
        self.keep(now_s)
        self.tracker.step()
        self.runs.step(now_s)

    def keep(self, now_s: float) -> None:
        """Maintain cameras, calibrations and slow picture jobs; may take a while."""
        self.camera.step(now_s)
        self.setup.step()
        self.jobs.step(now_s)
        track = self.tracker.tracked.track
        if track is not None:
            self.setup.learn_direction(track.pipette.direction)

    @property
    def status(self) -> MicroscopeStatus:
        """All that a view shows now; to be read once a frame, while someone looks at it.

        Cameras are looked for from the first time on.
        """
        self.camera.watched = True
        setup, tracked = self.setup, self.tracker.tracked
        view, camera = self.camera.view, self.camera.camera
        pixel_m, source = setup.scale
        positioning, adjustments = self.positioning, self.adjustments
        calibrating, focusing = adjustments.calibrating, adjustments.focusing
        tip = self.tracker.tip
        return MicroscopeStatus(
            cameras=self.camera.cameras,
            camera_problems=self.camera.problems,
            camera=None if camera is None else camera.identity,
            feed=view,
            objective=setup.objective,
            objectives=setup.objectives,
            calibration=setup.calibration,
            calibration_problem=setup.problem,
            pixel_m=pixel_m,
            scale_source=source,
            activity=self.runs.activity,
            calibrating=None if calibrating is None else calibrating.status,
            visiting=None if positioning.run is None else positioning.run.status,
            focusing=None if focusing is None else focusing.status,
            stacking=None if adjustments.stacking is None else adjustments.stacking.status,
            stopped=self.runs.stopped,
            planned=positioning.planned,
            path=self.tracker.path,
            tip=_tip(setup, tracked),
            cell=_cell(self.jobs, tip, pixel_m),
            measured=_measured(self.measured, tip, pixel_m),
            targets=tuple(positioning.sequence.targets),
            nano_limits=setup.nano_limits(None if tip is None else tip.pixel),
            focus_axes=adjustments.focus_axes,
            drift=self.jobs.drift,
            background=tracked.ground,
            frames_processed=tracked.processed,
            frames_skipped=tracked.skipped,
            truth=self.camera.truth,
        )

    # --- what is looked through -------------------------------------------------------------------

    def choose_objective(self, name: str) -> None:
        """Set the objective; raises MicroscopeError without a name, or during a run."""
        self._refuse_under_way()
        self.positioning.planned = None
        self.setup.choose_objective(name)

    # --- what moves; one at a time ----------------------------------------------------------------

    def calibrate(self, stage: str, *, whole_picture: bool = False) -> None:
        """Begin the guided calibration of ``micro`` or ``nano``; from then on the tip is tracked.

        ``whole_picture``: what is seen moves as a whole with the stage, and no tip before it.

        Raises
        ------
        InputError
            As :class:`CalibrationRun` and :meth:`Runs.begin`; then nothing has moved.
        """
        self.adjustments.calibrate(stage, whole_picture=whole_picture)
        if not whole_picture and self.tracker.tracked.state is TipState.OFF:
            self.tracker.switch(True)  # what it uncovers on its way becomes the background

    def move_focus(self, focus_m: float) -> None:
        """Move the microscope's focus drive, m; raises InputError if it has none, or cannot."""
        self._refuse_under_way()
        self.adjustments.focus_mover(FOCUS)(focus_m, None)

    def plan(self, pixel: FloatArray, *, stage: str | None = None) -> PlannedMove:
        """Plan the move for a click or drag, and show its ghost; nothing moves.

        Raises
        ------
        InputError
            As :meth:`ClickToMove.plan`.
        """
        return self.positioning.plan(pixel, stage)

    def cancel_plan(self) -> None:
        """Forget the planned move."""
        self.positioning.planned = None

    def go(self, *, confirmed: bool = False, permit: Permit | None = None) -> None:
        """Make the planned move, look, and correct until the tip is there.

        ``permit`` is that of the request, where it waited for a yes.

        Raises
        ------
        MicroscopeError
            If nothing is planned, the tip is not tracked, or a large move is not confirmed.
        InputError
            As :meth:`ClickToMove.go` and :meth:`Runs.begin`.
        """
        self.positioning.go(confirmed=confirmed, permit=permit or self.session.permit())

    def go_back(self) -> None:
        """Return to where the machine rested before its latest move; raises as ``undo``."""
        self._refuse_under_way()
        self.session.undo()

    def stop(self, *, by: str = PROGRAM) -> None:
        """Halt the machine, and end what is under way; ``by`` as of :meth:`MotionSession.stop`."""
        self.runs.stop(message("engine", "stopped"), by=by)
        self.session.stop(by=by)

    # --- targets ----------------------------------------------------------------------------------

    def mark_target(self, pixel: FloatArray) -> None:
        """Add a target behind the others."""
        self.positioning.sequence.mark(np.asarray(pixel, dtype=np.float64))

    def visit_next(self, *, confirmed: bool = False, permit: Permit | None = None) -> None:
        """Go to the next target; ``permit`` as in :meth:`go`.

        Raises
        ------
        MicroscopeError
            If there is none, or the way is so large that it must be confirmed.
        InputError
            As :meth:`go`.
        """
        self.positioning.next(confirmed=confirmed, permit=permit or self.session.permit())

    # --- vision -----------------------------------------------------------------------------------

    def track(self, on: bool, *, near: FloatArray | None = None) -> None:
        """Turn tracking on or off; ``near`` (2,), px, is an approximate position."""
        self.tracker.switch(on, near)

    def outline_cell(self, near: FloatArray) -> None:
        """Look for the outline of the cell about ``near`` (2,), px."""
        self.jobs.outline(np.asarray(near, dtype=np.float64), self.setup.pixel_m)

    def measure(self, begin: FloatArray, end: FloatArray) -> None:
        """Measure from one pixel (2,) to another."""
        ends = np.asarray(begin, dtype=np.float64), np.asarray(end, dtype=np.float64)
        if not (np.isfinite(ends[0]).all() and np.isfinite(ends[1]).all()):
            raise MicroscopeError(
                message("engine", "measure: a pixel is not a finite number; draw the line again")
            )
        self.measured = ends

    def forget_measure(self) -> None:
        """Remove the measured line."""
        self.measured = None

    # --- inside -----------------------------------------------------------------------------------

    def _pressing(self) -> Pressing:
        phase = self._penetration()
        if phase in _ARMED:
            return Pressing.SOON
        return Pressing.NO if phase in _AT_REST else Pressing.YES

    def _refuse_under_way(self) -> None:
        if self.runs.activity is not Activity.NONE:
            raise MicroscopeError(
                message("engine", "a {activity} is under way; wait, or stop it first").fill(
                    activity=self.runs.activity
                )
            )

    def _failed(self, _: Exception) -> None:
        self._told(
            message(
                "engine",
                "A step of the microscope failed; the log has the cause. If this repeats, open "
                "the camera again",
            )
        )


def _tip(setup: OpticalSetup, tracked: Tracked) -> TipSeen:
    track = tracked.track
    if track is None:
        return TipSeen(tracked.state, reason=tracked.reason)
    place = sigma = None
    kept = setup.calibration
    if kept is not None and kept.micro is not None:
        place, spread = tip_in_plane(track.pixel, track.covariance, kept.micro)
        sigma = np.sqrt(np.diag(spread))
    return TipSeen(
        state=tracked.state,
        pixel=track.pixel,
        sigma_px=float(np.sqrt(np.linalg.eigvalsh(track.covariance)[-1])),
        direction=track.pipette.direction,
        depth=track.depth,
        place_m=place,
        sigma_m=sigma,
        quality=track.quality,
        reason=tracked.reason,
    )


def _cell(jobs: PictureJobs, tip: TipTrack | None, pixel_m: float | None) -> CellSeen:
    outline, reason = jobs.cell, jobs.reason
    if outline is None or tip is None:
        return CellSeen(outline, reason=reason)
    # The way of the tip is out of its body, which leads the other way.
    ahead = membrane_ahead(outline, tip.pixel, tip.covariance, tip.pipette.direction + np.pi)
    if ahead is None or pixel_m is None:
        return CellSeen(outline, ahead, reason=reason)
    away, doubt = ahead.distance * pixel_m, ahead.distance_uncertainty * pixel_m
    return CellSeen(outline, ahead, away, doubt, reason)


def _measured(
    ends: tuple[FloatArray, FloatArray] | None, tip: TipTrack | None, pixel_m: float | None
) -> Measured | None:
    if ends is None:
        return None
    way = ends[1] - ends[0]
    length, angle = float(np.hypot(*way)), float(np.arctan2(way[1], way[0]))
    to_body = None
    if tip is not None:
        between = abs((angle - tip.pipette.direction + 0.5 * np.pi) % np.pi - 0.5 * np.pi)
        to_body = float(between)
    return Measured(
        begin=ends[0],
        end=ends[1],
        length_px=length,
        length_m=None if pixel_m is None else length * pixel_m,
        angle=angle,
        to_body=to_body,
    )
