"""Moves of the tip to clicked points and marked targets."""

import numpy as np

from rotemina.app.errors import MicroscopeError
from rotemina.app.microscope.camera_in_use import CameraInUse
from rotemina.app.microscope.click_corrections import VisitRun
from rotemina.app.microscope.click_target import ClickMover, PlannedMove
from rotemina.app.microscope.optical_setup import OpticalSetup
from rotemina.app.microscope.runs import MicroscopeRunner
from rotemina.app.microscope.settled_frame import SETTLING_TIME_S
from rotemina.app.microscope.status import MicroscopeActivity
from rotemina.app.microscope.targets import TargetSequence
from rotemina.app.microscope.tip_tracker import TipTracker
from rotemina.app.motion.session import MotionSession
from rotemina.drivers.contract import Clock, Permit
from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import ChainError
from rotemina.sim.messages import message
from rotemina.sim.vision import to_grey

# Longest time for which tracking may lose the tip during a move before the run is aborted.
MAX_LOST_S = 1.0


class TipPositioning:
    """Plans and starts moves of the tracked tip to pixels, one run at a time.

    Parameters
    ----------
    session : MotionSession
    camera : CameraInUse
    setup : OpticalSetup
    tracker : TipTracker
    runner : MicroscopeRunner
    clock : callable
    """

    def __init__(
        self,
        session: MotionSession,
        camera: CameraInUse,
        setup: OpticalSetup,
        tracker: TipTracker,
        runner: MicroscopeRunner,
        clock: Clock,
    ) -> None:
        self._session, self._camera, self._setup = session, camera, setup
        self._tracker, self._runner, self._clock = tracker, runner, clock
        self.planned_move: PlannedMove | None = None
        #: The current visit, or the latest one.
        self.visit_run: VisitRun | None = None
        # Permit for the next visit.
        self._permit: Permit | None = None
        self.target_sequence = TargetSequence(
            lambda pixel: self._make_visit(self._plan_move(pixel, None), confirmed=True)
        )

    def plan(self, pixel: FloatArray, stage: str | None) -> PlannedMove:
        """Plan the move for a click; nothing moves. For errors see :meth:`ClickMover.plan`."""
        self.planned_move = None
        self.planned_move = self._plan_move(pixel, stage)
        return self.planned_move

    def go(self, *, confirmed: bool, permit: Permit) -> None:
        """Make the planned move, and correct it until the tip is at the goal.

        ``permit`` was issued with the request. If the machine was stopped since then, the permit is
        no longer valid and nothing moves.

        Raises
        ------
        MicroscopeError
            If no move is planned, the tip is not tracked, or a large move is not confirmed.
        InputError
            See :meth:`ClickMover.go` and :meth:`MicroscopeRunner.begin`.
        """
        move = self.planned_move
        if move is None:
            raise MicroscopeError("no move is planned; click in the picture first")
        self._permit = permit
        self._runner.begin(
            MicroscopeActivity.CLICK, lambda: self._make_visit(move, confirmed=confirmed)
        )
        self.planned_move = None

    def visit_next(self, *, confirmed: bool, permit: Permit) -> None:
        """Move to the next target; ``permit`` as in :meth:`go`.

        Raises
        ------
        MicroscopeError
            If no target is left, or the move is so large that it needs a confirmation.
        InputError
            See :meth:`go`.
        """
        unvisited = next(
            (target for target in self.target_sequence.targets if target.visit is None), None
        )
        if unvisited is not None and not confirmed:
            self._make_mover().require_confirmation(self._plan_move(unvisited.pixel, None))

        self._permit = permit

        def start_next_visit() -> TargetSequence:
            self.target_sequence.visit_next()
            return self.target_sequence

        self._runner.begin(MicroscopeActivity.TARGETS, start_next_visit)

    def find_tracking_problem(self, activity: MicroscopeActivity) -> str:
        """Return why the tracked tip must not guide this activity, or an empty text."""
        result = self._tracker.result
        if (
            activity not in (MicroscopeActivity.CLICK, MicroscopeActivity.TARGETS)
            or result.lost_since_s is None
        ):
            return ""
        if result.frame is None or result.frame.host_time_s - result.lost_since_s < MAX_LOST_S:
            return ""
        return message("engine", "the tip is lost: {reason}").fill(reason=result.reason)

    def _make_mover(self) -> ClickMover:
        try:
            return ClickMover(self._session, self._setup.calibration)
        except ChainError as error:
            raise MicroscopeError(
                "a click cannot move the tip: {error}", error=str(error)
            ) from error

    def _plan_move(self, pixel: FloatArray, stage: str | None) -> PlannedMove:
        return self._make_mover().plan(
            np.asarray(pixel, dtype=np.float64),
            stage=stage,
            tip_px=self._find_tip_at_rest(),
            frame=self._camera.newest_frame,
        )

    def _find_tip_at_rest(self) -> FloatArray | None:
        """Return the tip's pixel (2,), or None if its picture may be older than the latest motion.

        A move starts at the current command, so the picture must show the tip at that position.
        """
        tip, frame = self._tracker.tip, self._tracker.result.frame
        last_motion_s = self._session.snapshot().last_motion_s
        if tip is None or frame is None or frame.host_time_s < last_motion_s + SETTLING_TIME_S:
            return None
        return tip.pixel

    def _make_visit(self, move: PlannedMove, *, confirmed: bool) -> VisitRun:
        tip, frame = self._tracker.tip, self._tracker.result.frame
        if tip is None or frame is None:
            raise MicroscopeError(
                "the tip is not tracked; turn on tracking, so that the move can be checked"
            )
        background = self._tracker.get_background(move.pixel)
        self.visit_run = VisitRun(
            self._make_mover(),
            lambda: self._camera.newest_frame,
            move,
            tip,
            now_s=self._clock(),
            earlier_image=to_grey(frame.pixels) if background is None else background,
            earlier_is_clear=background is not None,
            confirmed=confirmed,
            permit=self._permit,
        )
        return self.visit_run
