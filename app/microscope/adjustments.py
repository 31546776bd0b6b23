"""Calibration, autofocus and z-stack, whose results are stored for each camera and objective."""

from collections.abc import Callable
from datetime import UTC, datetime

import numpy as np

from rotemina.app.errors import MicroscopeError
from rotemina.app.microscope.calibration_file import FocusCalibration
from rotemina.app.microscope.calibration_run import StageCalibrationPhase, StageCalibrationRun
from rotemina.app.microscope.camera_in_use import CameraInUse
from rotemina.app.microscope.focus_run import FocusRun, MicroscopeRunState
from rotemina.app.microscope.optical_setup import OpticalSetup
from rotemina.app.microscope.runs import MicroscopeRunner
from rotemina.app.microscope.stack_run import StackRun, compute_stack_positions
from rotemina.app.microscope.status import FocusAxis, MicroscopeActivity
from rotemina.app.microscope.tip_tracker import TipTracker
from rotemina.app.motion.session import MotionSession
from rotemina.drivers.cameras import FocusDrive
from rotemina.drivers.contract import Clock, Permit
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message
from rotemina.sim.units import format_exact

# Name of the microscope's focus drive, used in the same way as the names of the axes.
FOCUS_DRIVE = "focus"
# Owner of the motions of an axis that focuses, during an autofocus or a z-stack.
FOCUS_MOTION_OWNER = "autofocus"
DEFAULT_FOCUS_REACH_M = 50e-6
# The z axes of the micro and of the nano stage.
_FOCUS_AXES = ("z", "zn")
# Half the side of the square around the tip in which sharpness is measured.
_SHARPNESS_HALF_WIDTH_PX = 30


class MicroscopeProcedures:
    """Starts calibration, autofocus and z-stack, and stores their results.

    Parameters
    ----------
    session : MotionSession
    camera : CameraInUse
    setup : OpticalSetup
    tracker : TipTracker
    runner : MicroscopeRunner
    clock : callable
    notify : callable
        Called with the reason if a result could not be saved.
    """

    def __init__(
        self,
        session: MotionSession,
        camera: CameraInUse,
        setup: OpticalSetup,
        tracker: TipTracker,
        runner: MicroscopeRunner,
        clock: Clock,
        notify: Callable[[str], None],
    ) -> None:
        self._session, self._camera, self._setup = session, camera, setup
        self._tracker, self._runner, self._clock, self._notify = tracker, runner, clock, notify
        #: The run of each kind that is under way, or else the latest one.
        self.calibration_run: StageCalibrationRun | None = None
        self.focus_run: FocusRun | None = None
        self.stack_run: StackRun | None = None

    @property
    def focus_axes(self) -> tuple[FocusAxis, ...]:
        """The microscope's drive and the machine's axes that can focus the picture."""
        camera, available_axes = self._camera.camera, []
        if isinstance(camera, FocusDrive):
            available_axes.append(FocusAxis(FOCUS_DRIVE, camera.focus_m, *camera.focus_range_m))
        command, axes = self._session.reported.command, self._session.robot.axes
        for axis in _FOCUS_AXES:
            if axis in axes:
                low, high = axes[axis].range
                available_axes.append(FocusAxis(axis, command.get(axis), low, high))
        return tuple(available_axes)

    def calibrate(self, stage: str, *, whole_picture: bool) -> None:
        """Start the calibration of a stage.

        Raises
        ------
        InputError
            See :class:`StageCalibrationRun` and :meth:`MicroscopeRunner.begin`.
        """
        # Without a pipette there is no direction that the calibration would have to find.
        pipette, is_pipette_direction_known = (
            (None, True) if whole_picture else self._setup.make_pipette()
        )

        def make_run() -> StageCalibrationRun:
            self.calibration_run = StageCalibrationRun(
                self._session,
                lambda: self._camera.newest_frame,
                stage,
                pipette,
                now_s=self._clock(),
                direction_known=is_pipette_direction_known,
            )
            return self.calibration_run

        self._runner.begin(
            MicroscopeActivity.CALIBRATION, make_run, lambda: self._store_calibration(stage)
        )

    def autofocus(
        self, name: str = FOCUS_DRIVE, low: float | None = None, high: float | None = None
    ) -> None:
        """Focus on the tip, or on the whole picture if no tip is tracked.

        Parameters
        ----------
        name : str
            ``focus`` for the microscope's drive, or an axis of the machine.
        low, high : float, optional
            Ends of the search, m; by default 50 µm on each side of the current position, limited to
            the range of the axis.

        Raises
        ------
        InputError
            See :class:`FocusRun` and :meth:`MicroscopeRunner.begin`.
        """
        axis, position = self._find_focus_axis(name)
        begin = max(axis.low, position - DEFAULT_FOCUS_REACH_M) if low is None else low
        end = min(axis.high, position + DEFAULT_FOCUS_REACH_M) if high is None else high

        def make_run() -> FocusRun:
            self.focus_run = FocusRun(
                self._session,
                lambda: self._camera.newest_frame,
                self.make_focus_mover(name),
                begin,
                end,
                now_s=self._clock(),
                window=self._choose_sharpness_window(),
            )
            return self.focus_run

        self._runner.begin(MicroscopeActivity.AUTOFOCUS, make_run, lambda: self._store_focus(name))

    def take_stack(self, name: str, first: float, last: float, step: float) -> None:
        """Take a picture at each position from ``first`` to ``last`` in steps of ``step``, m.

        ``name`` is ``focus`` for the microscope's drive, or an axis of the machine.

        Raises
        ------
        InputError
            See :class:`StackRun` and :meth:`MicroscopeRunner.begin`. In that case nothing has
            moved.
        """
        axis, start = self._find_focus_axis(name)
        positions = compute_stack_positions(first, last, step)
        for position in (positions[0], positions[-1]):
            if not axis.low <= position <= axis.high:
                raise MicroscopeError(
                    "z-stack: {name} at {place}: must be {low} to {high}",
                    name=name,
                    place=format_exact(position, "m"),
                    low=format_exact(axis.low, "m"),
                    high=format_exact(axis.high, "m"),
                )

        def make_run() -> StackRun:
            self.stack_run = StackRun(
                self._session,
                lambda: self._camera.newest_frame,
                self.make_focus_mover(name),
                name,
                positions,
                start,
                now_s=self._clock(),
            )
            return self.stack_run

        self._runner.begin(MicroscopeActivity.STACK, make_run)

    def make_focus_mover(self, name: str) -> Callable[[float, Permit | None], None]:
        """Return a function that moves the drive or axis to a position, m, under a permit.

        Raises
        ------
        MicroscopeError
            If the microscope's focus has no motor.
        """
        camera = self._camera.camera
        if name != FOCUS_DRIVE:
            return lambda position, permit: self._session.go_to(
                {name: position}, FOCUS_MOTION_OWNER, permit=permit
            )
        if not isinstance(camera, FocusDrive):
            raise MicroscopeError(
                "this microscope has no focus motor; use an axis, or focus by hand"
            )

        def move(position: float, permit: Permit | None) -> None:
            if permit is not None:
                permit.check()
            camera.move_focus(position)

        return move

    def _find_focus_axis(self, name: str) -> tuple[FocusAxis, float]:
        """Return the focus axis with this name, and its position, m."""
        axes = self.focus_axes
        match = next((axis for axis in axes if axis.name == name), None)
        if match is None:
            known = ", ".join(axis.name for axis in axes) or "nothing"
            raise MicroscopeError(
                "{name} cannot focus here; available: {known}", name=repr(name), known=known
            )
        if match.position is None:
            raise MicroscopeError(
                "{name}: its position is unknown; connect the machine first", name=name
            )
        return match, match.position

    def _choose_sharpness_window(self) -> tuple[slice, slice]:
        tip = self._tracker.tip
        if tip is None:
            return slice(None), slice(None)
        low = np.maximum(np.rint(tip.pixel).astype(int) - _SHARPNESS_HALF_WIDTH_PX, 0)
        return slice(low[1], low[1] + 2 * _SHARPNESS_HALF_WIDTH_PX), slice(
            low[0], low[0] + 2 * _SHARPNESS_HALF_WIDTH_PX
        )

    def _store_calibration(self, stage: str) -> None:
        run, frame = self.calibration_run, self._camera.newest_frame
        if run is None or frame is None or run.status.phase is not StageCalibrationPhase.DONE:
            return
        if run.pipette is not None:
            self._setup.store_direction(run.pipette.direction)
        calibration = run.status.calibration
        assert calibration is not None
        self._store(lambda: self._setup.store_stage(stage, calibration, frame.region))

    def _store_focus(self, name: str) -> None:
        run, frame = self.focus_run, self._camera.newest_frame
        if run is None or frame is None or run.status.state is not MicroscopeRunState.DONE:
            return
        peak = run.status.peak
        assert peak is not None
        focus = FocusCalibration(
            date=datetime.now(UTC).isoformat(timespec="seconds"),
            axis=name,
            sharpest=peak.place,
            uncertainty=peak.uncertainty,
        )
        self._store(lambda: self._setup.store_focus(focus, frame.region))

    def _store(self, save: Callable[[], None]) -> None:
        try:
            save()
        except InputError as error:
            # The result remains in use until the program ends, although it could not be saved.
            self._notify(message("engine", "Microscope: {error}").fill(error=str(error)))
