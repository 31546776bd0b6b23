"""Moves of the tip to clicks and marked targets: planned, executed, and corrected."""

import numpy as np

from rotemina.app.microscope.camera_in_use import CameraInUse
from rotemina.app.microscope.click_corrections import ClickRun
from rotemina.app.microscope.click_target import ClickToMove, PlannedMove
from rotemina.app.microscope.errors import MicroscopeError
from rotemina.app.microscope.optical_setup import OpticalSetup
from rotemina.app.microscope.runs import Runs
from rotemina.app.microscope.settled_frame import SETTLE_S
from rotemina.app.microscope.status import Activity
from rotemina.app.microscope.targets import TargetSequence
from rotemina.app.microscope.tip_tracker import TipTracker
from rotemina.app.motion.session import MotionSession
from rotemina.drivers.clock import Clock
from rotemina.drivers.gate import Permit
from rotemina.sim.arrays import FloatArray
from rotemina.sim.kinematics.chain import ChainError
from rotemina.sim.messages import message
from rotemina.sim.vision.image import grey

LOST_S = 1.0  # that a tip may be lost on its way to a click


class TipPositioning:
    """Brings the tracked tip to pixels, one run at a time.

    Parameters
    ----------
    session : MotionSession
    camera : CameraInUse
    setup : OpticalSetup
    tracker : TipTracker
    runs : Runs
    clock : callable
    """

    def __init__(
        self,
        session: MotionSession,
        camera: CameraInUse,
        setup: OpticalSetup,
        tracker: TipTracker,
        runs: Runs,
        clock: Clock,
    ) -> None:
        self._session, self._camera, self._setup = session, camera, setup
        self._tracker, self._runs, self._clock = tracker, runs, clock
        self.planned: PlannedMove | None = None
        #: The present visit, or the latest one.
        self.run: ClickRun | None = None
        self._permit: Permit | None = None  # of the visit that is being begun
        self.sequence = TargetSequence(
            lambda pixel: self._visit(self._thought(pixel, None), confirmed=True)
        )

    def plan(self, pixel: FloatArray, stage: str | None) -> PlannedMove:
        """Plan the move for a click; nothing moves. Raises as :meth:`ClickToMove.plan`."""
        self.planned = None
        self.planned = self._thought(pixel, stage)
        return self.planned

    def go(self, *, confirmed: bool, permit: Permit) -> None:
        """Make the planned move, look, and correct until the tip is there.

        ``permit`` is that of the request: no stop that came after it lets anything move.

        Raises
        ------
        MicroscopeError
            If nothing is planned, the tip is not tracked, or a large move is not confirmed.
        InputError
            As :meth:`ClickToMove.go` and :meth:`Runs.begin`.
        """
        move = self.planned
        if move is None:
            raise MicroscopeError(
                message("engine", "no move is planned; click in the picture first")
            )
        self._permit = permit
        self._runs.begin(Activity.CLICK, lambda: self._visit(move, confirmed=confirmed))
        self.planned = None

    def next(self, *, confirmed: bool, permit: Permit) -> None:
        """Go to the next target; ``permit`` as in :meth:`go`.

        Raises
        ------
        MicroscopeError
            If there is none, or the way is so large that it must be confirmed.
        InputError
            As :meth:`go`.
        """
        waiting = next((one for one in self.sequence.targets if one.visit is None), None)
        if waiting is not None and not confirmed:
            self._clicks().check(self._thought(waiting.pixel, None))

        self._permit = permit

        def make() -> TargetSequence:
            self.sequence.next()
            return self.sequence

        self._runs.begin(Activity.TARGETS, make)

    def doubt(self, activity: Activity) -> str:
        """Return why the tracked tip must not be used for motion, or None."""
        tracked = self._tracker.tracked
        if activity not in (Activity.CLICK, Activity.TARGETS) or tracked.lost_since_s is None:
            return ""
        if tracked.frame is None or tracked.frame.host_time_s - tracked.lost_since_s < LOST_S:
            return ""
        return message("engine", "the tip is lost: {reason}").fill(reason=tracked.reason)

    def _clicks(self) -> ClickToMove:
        try:
            return ClickToMove(self._session, self._setup.calibration)
        except ChainError as error:
            raise MicroscopeError(
                message("engine", "no tip can be moved by a click: {error}").fill(error=str(error))
            ) from error

    def _thought(self, pixel: FloatArray, stage: str | None) -> PlannedMove:
        return self._clicks().plan(
            np.asarray(pixel, dtype=np.float64),
            stage=stage,
            tip_px=self._seen_at_rest(),
            frame=self._camera.newest,
        )

    def _seen_at_rest(self) -> FloatArray | None:
        """Return the tip's pixel (2,), unless its picture may be older than the latest motion.

        The targets of a move begin at the present command, so the picture must show that place.
        """
        tip, frame = self._tracker.tip, self._tracker.tracked.frame
        moved_s = self._session.snapshot().moved_s
        if tip is None or frame is None or frame.host_time_s < moved_s + SETTLE_S:
            return None
        return tip.pixel

    def _visit(self, move: PlannedMove, *, confirmed: bool) -> ClickRun:
        tip, frame = self._tracker.tip, self._tracker.tracked.frame
        if tip is None or frame is None:
            raise MicroscopeError(
                message(
                    "engine",
                    "the tip is not tracked; turn on tracking, so that the move can be checked",
                )
            )
        ground = self._tracker.ground_about(move.pixel)
        self.run = ClickRun(
            self._clicks(),
            lambda: self._camera.newest,
            move,
            tip,
            now_s=self._clock(),
            before=grey(frame.pixels) if ground is None else ground,
            clear=ground is not None,
            confirmed=confirmed,
            permit=self._permit,
        )
        return self.run
