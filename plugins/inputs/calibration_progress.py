"""A calibration in progress: measured in steps, then curve, direction and travel."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import asdict, replace
from enum import StrEnum

from pydantic import ValidationError

from rotemina.app.motion.teleoperation.axis_calibration import (
    AxisCalibration,
    Calibration,
    CalibrationError,
)
from rotemina.app.motion.teleoperation.input_arbiter import DeviceView
from rotemina.app.motion.teleoperation.stick_calibration import CalibrationRun
from rotemina.drivers.inputs.device import InputReading
from rotemina.plugins.inputs import tr

REST_S = 1.0  # for which it must be left alone, so that its noise is seen
_SWITCHES = ("hat",)  # axes of -1, 0, 1: there is nothing to measure
_TRIGGERS = ("accelerator", "brake", "clutch", "throttle")


class Step(StrEnum):
    """Where a calibration is."""

    EDIT = "edit"  # nothing is being measured
    REST = "rest"
    SWEEP = "sweep"


class Calibrating:
    """The calibration of one device, until it is kept or discarded.

    Parameters
    ----------
    view : DeviceView
    """

    def __init__(self, view: DeviceView) -> None:
        self.device = view.device
        #: What is in use.
        self.kept: Calibration = view.calibration
        #: What was changed, and is not yet in use.
        self.draft: Calibration = view.calibration
        #: Of the latest measurement: axes that stay as they were, and why.
        self.problems: Mapping[str, str] = {}
        self.step = Step.EDIT
        self._run: CalibrationRun | None = None
        self._begun_s = 0.0

    @property
    def changed(self) -> bool:
        """Whether there is something to keep or to discard."""
        return self.draft != self.kept

    @property
    def measurable(self) -> tuple[str, ...]:
        """Axes that are measured unless someone wishes otherwise."""
        return tuple(axis for axis in self.device.axes if not _begins(axis, _SWITCHES))

    @property
    def one_sided(self) -> tuple[str, ...]:
        """Axes that rest at an end, by their calibration or, without one, by their name."""
        return tuple(axis for axis in self.device.axes if self._rests_at_end(axis))

    @property
    def ranges(self) -> Mapping[str, tuple[float, float]]:
        """Least and greatest reading of each axis so far, while it is measured."""
        return {} if self._run is None else self._run.ranges

    @property
    def missing(self) -> Mapping[str, str]:
        """What is still wrong with each axis while it is measured."""
        return {} if self._run is None else self._run.problems

    def begin(
        self,
        wanted: Sequence[str],
        one_sided: Collection[str],
        last: InputReading | None,
        now_s: float,
    ) -> None:
        """Begin to measure: the device is to be left alone.

        Raises
        ------
        CalibrationError
            If no axis is wanted.
        """
        if not wanted:
            raise CalibrationError(tr("no axis is chosen: choose the axes to measure"))
        sides = [axis for axis in one_sided if axis in wanted]
        self._run = CalibrationRun(self.device.axes, wanted, sides, last)
        self.step, self._begun_s, self.problems = Step.REST, now_s, {}

    def receive(self, readings: Sequence[InputReading]) -> None:
        """Take in what the device has said since the measurement began."""
        if self._run is not None:
            for reading in readings:
                if reading.host_time_s >= self._begun_s:
                    self._run.feed(reading)

    def rest_left_s(self, now_s: float) -> float:
        """Return for how long it is still to be left alone."""
        return max(REST_S - (now_s - self._begun_s), 0.0) if self.step is Step.REST else 0.0

    def sweep(self) -> None:
        """Continue to the ends."""
        assert self._run is not None
        self._run.sweep()
        self.step = Step.SWEEP

    def finish(self) -> None:
        """Take over what was measured well; the other axes stay as they were."""
        assert self._run is not None
        before = {axis: self.draft.axis(axis) for axis in self.device.axes}
        self.problems = self._run.problems
        self.draft = self.draft.with_axes(self._run.sound(before))
        self.cancel()

    def cancel(self) -> None:
        """Cancel the measurement."""
        self._run = None
        self.step = Step.EDIT

    def discard(self) -> None:
        """Go back to what is in use."""
        self.draft, self.problems = self.kept, {}

    def change(self, axis: str, **changes: float | bool | None) -> None:
        """Change settings of one axis.

        Raises
        ------
        CalibrationError
            If they do not go together.
        """
        self.draft = self.draft.with_axes({axis: changed(axis, self.draft.axis(axis), **changes)})

    def forget(self, axis: str) -> None:
        """Give one axis the settings of one that was never calibrated."""
        axes = {name: one for name, one in self.draft.axes.items() if name != axis}
        self.draft = replace(self.draft, axes=axes)

    def _rests_at_end(self, axis: str) -> bool:
        if axis in self.kept.axes:
            one = self.kept.axes[axis]
            return one.centre in (one.low, one.high)
        return _begins(axis, _TRIGGERS)


def changed(axis: str, before: AxisCalibration, **changes: float | bool | None) -> AxisCalibration:
    """Return a calibration with some settings changed.

    Raises
    ------
    CalibrationError
        If they do not go together, or one is out of its bounds.
    """
    try:
        return AxisCalibration(**{**asdict(before), **changes})
    except ValidationError as error:
        detail = error.errors()[0]
        where = ".".join(map(str, detail["loc"])) or tr("its settings")
        reason = str(detail.get("ctx", {}).get("error", detail["msg"]))
        raise CalibrationError(
            tr("axis {axis}, {where}: {reason}").format(axis=axis, where=where, reason=reason)
        ) from error


def summary(one: AxisCalibration) -> str:
    """Return where an axis ends and rests, in one line."""
    rest = (
        tr("rests at an end")
        if one.centre in (one.low, one.high)
        else tr("rests at {centre:+.2f}").format(centre=one.centre)
    )
    return tr("{low:+.2f} to {high:+.2f}, {rest}").format(low=one.low, high=one.high, rest=rest)


def _begins(axis: str, names: tuple[str, ...]) -> bool:
    return axis.casefold().startswith(names)
