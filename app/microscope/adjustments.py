"""Calibration and autofocus, whose results are stored for camera and objective."""

from collections.abc import Callable
from datetime import UTC, datetime

import numpy as np

from rotemina.app.microscope.calibration_file import FocusCalibration
from rotemina.app.microscope.calibration_run import CalibrationRun, Phase
from rotemina.app.microscope.camera_in_use import CameraInUse
from rotemina.app.microscope.errors import MicroscopeError
from rotemina.app.microscope.focus_run import FocusRun, Search
from rotemina.app.microscope.optical_setup import OpticalSetup
from rotemina.app.microscope.runs import Runs
from rotemina.app.microscope.stack_run import StackRun, places_of
from rotemina.app.microscope.status import Activity, FocusAxis
from rotemina.app.microscope.tip_tracker import TipTracker
from rotemina.app.motion.session import MotionSession
from rotemina.drivers.cameras.camera import FocusDrive
from rotemina.drivers.clock import Clock
from rotemina.drivers.gate import Permit
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message
from rotemina.sim.quantities import exact

FOCUS = "focus"  # the microscope's own drive
AUTOFOCUS = "autofocus"
FOCUSED_M = 50e-6  # searched each way by default
_AXES = ("z", "zn")  # that bring something into focus
_SHARP_PX = 30  # about the tip, that is to be sharp


class Adjustments:
    """Begins them, and keeps what they find.

    Parameters
    ----------
    session : MotionSession
    camera : CameraInUse
    setup : OpticalSetup
    tracker : TipTracker
    runs : Runs
    clock : callable
    told : callable
        Gets why something could not be kept.
    """

    def __init__(
        self,
        session: MotionSession,
        camera: CameraInUse,
        setup: OpticalSetup,
        tracker: TipTracker,
        runs: Runs,
        clock: Clock,
        told: Callable[[str], None],
    ) -> None:
        self._session, self._camera, self._setup = session, camera, setup
        self._tracker, self._runs, self._clock, self._told = tracker, runs, clock, told
        #: The present ones, or the latest.
        self.calibrating: CalibrationRun | None = None
        self.focusing: FocusRun | None = None
        self.stacking: StackRun | None = None

    @property
    def focus_axes(self) -> tuple[FocusAxis, ...]:
        """What can be focused with."""
        camera, found = self._camera.camera, []
        if isinstance(camera, FocusDrive):
            found.append(FocusAxis(FOCUS, camera.focus_m, *camera.focus_range_m))
        command, axes = self._session.reported.command, self._session.robot.axes
        for axis in _AXES:
            if axis in axes:
                low, high = axes[axis].range
                found.append(FocusAxis(axis, command.get(axis), low, high))
        return tuple(found)

    def calibrate(self, stage: str, *, whole_picture: bool) -> None:
        """Begin the calibration of a stage; raises as :class:`CalibrationRun`, `Runs.begin`."""
        pipette, known = (None, True) if whole_picture else self._setup.pipette()

        def make() -> CalibrationRun:
            self.calibrating = CalibrationRun(
                self._session,
                lambda: self._camera.newest,
                stage,
                pipette,
                now_s=self._clock(),
                direction_known=known,
            )
            return self.calibrating

        self._runs.begin(Activity.CALIBRATION, make, lambda: self._calibrated(stage))

    def autofocus(
        self, name: str = FOCUS, low: float | None = None, high: float | None = None
    ) -> None:
        """Bring the tip, or where none is tracked the picture, into focus.

        Parameters
        ----------
        name : str
            ``focus`` for the microscope's drive, or an axis of the machine.
        low, high : float, optional
            Where to search, m; by default 50 µm each way, as far as it goes.

        Raises
        ------
        InputError
            As :class:`FocusRun` and :meth:`Runs.begin`.
        """
        axis, position = self._focus_axis(name)
        begin = max(axis.low, position - FOCUSED_M) if low is None else low
        end = min(axis.high, position + FOCUSED_M) if high is None else high

        def make() -> FocusRun:
            self.focusing = FocusRun(
                self._session,
                lambda: self._camera.newest,
                self.focus_mover(name),
                begin,
                end,
                now_s=self._clock(),
                part=self._sharp_part(),
            )
            return self.focusing

        self._runs.begin(Activity.AUTOFOCUS, make, lambda: self._focused(name))

    def stack(self, name: str, first: float, last: float, step: float) -> None:
        """Take pictures from ``first`` to ``last`` by ``step``, m, of the drive or an axis.

        Raises
        ------
        InputError
            As :class:`StackRun` and :meth:`Runs.begin`; then nothing has moved.
        """
        axis, back = self._focus_axis(name)
        places = places_of(first, last, step)
        for place in (places[0], places[-1]):
            if not axis.low <= place <= axis.high:
                raise MicroscopeError(
                    message("engine", "z-stack: {name} at {place}: must be {low} to {high}").fill(
                        name=name,
                        place=exact(place, "m"),
                        low=exact(axis.low, "m"),
                        high=exact(axis.high, "m"),
                    )
                )

        def make() -> StackRun:
            self.stacking = StackRun(
                self._session,
                lambda: self._camera.newest,
                self.focus_mover(name),
                name,
                places,
                back,
                now_s=self._clock(),
            )
            return self.stacking

        self._runs.begin(Activity.STACK, make)

    def focus_mover(self, name: str) -> Callable[[float, Permit | None], None]:
        """Return what goes to a focus place, m, with the permit of a plan.

        Raises
        ------
        MicroscopeError
            If the microscope's focus has no motor.
        """
        camera = self._camera.camera
        if name != FOCUS:
            return lambda place, permit: self._session.go_to(
                {name: place}, AUTOFOCUS, permit=permit
            )
        if not isinstance(camera, FocusDrive):
            raise MicroscopeError(
                message(
                    "engine", "this microscope has no focus motor; use an axis, or focus by hand"
                )
            )

        def move(place: float, permit: Permit | None) -> None:
            if permit is not None:
                permit.check()
            camera.move_focus(place)

        return move

    def _focus_axis(self, name: str) -> tuple[FocusAxis, float]:
        """Return what has a name, and where it is, m."""
        axes = self.focus_axes
        found = next((one for one in axes if one.name == name), None)
        if found is None:
            known = ", ".join(one.name for one in axes) or "nothing"
            raise MicroscopeError(
                message("engine", "{name} cannot focus here; available: {known}").fill(
                    name=repr(name), known=known
                )
            )
        if found.position is None:
            raise MicroscopeError(
                message(
                    "engine", "{name}: its position is unknown; connect the machine first"
                ).fill(name=name)
            )
        return found, found.position

    def _sharp_part(self) -> tuple[slice, slice]:
        tip = self._tracker.tip
        if tip is None:
            return slice(None), slice(None)
        low = np.maximum(np.rint(tip.pixel).astype(int) - _SHARP_PX, 0)
        return slice(low[1], low[1] + 2 * _SHARP_PX), slice(low[0], low[0] + 2 * _SHARP_PX)

    def _calibrated(self, stage: str) -> None:
        run, frame = self.calibrating, self._camera.newest
        if run is None or frame is None or run.status.phase is not Phase.DONE:
            return
        if run.pipette is not None:
            self._setup.learn_direction(run.pipette.direction)
        found = run.status.calibration
        assert found is not None
        self._keep(lambda: self._setup.keep_stage(stage, found, frame.region))

    def _focused(self, name: str) -> None:
        run, frame = self.focusing, self._camera.newest
        if run is None or frame is None or run.status.search is not Search.DONE:
            return
        peak = run.status.peak
        assert peak is not None
        found = FocusCalibration(
            date=datetime.now(UTC).isoformat(timespec="seconds"),
            axis=name,
            sharpest=peak.place,
            uncertainty=peak.uncertainty,
        )
        self._keep(lambda: self._setup.keep_focus(found, frame.region))

    def _keep(self, keep: Callable[[], None]) -> None:
        try:
            keep()
        except InputError as error:  # it is known until the program ends all the same
            self._told(message("engine", "Microscope: {error}").fill(error=str(error)))
