"""Calibration of a device in progress: a measurement in steps, then changes of single axes."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import asdict, replace
from enum import StrEnum

from pydantic import ValidationError

from rotemina.app.errors import InputCalibrationError
from rotemina.app.motion.inputs import (
    InputAxisCalibration,
    InputCalibration,
    InputDeviceView,
    StickCalibrationRun,
)
from rotemina.drivers.inputs import InputReading
from rotemina.plugins.inputs import tr

# The device must not be touched for this time, so that its noise can be measured.
REST_DURATION_S = 1.0
# Axes with these prefixes have only the values −1, 0 and 1, so there is nothing to measure.
_SWITCH_PREFIXES = ("hat",)
# Axes with these prefixes rest at one end.
_TRIGGER_PREFIXES = ("accelerator", "brake", "clutch", "throttle")


class CalibrationStep(StrEnum):
    """Step of a calibration. Nothing is measured in ``EDIT``."""

    EDIT = "edit"
    REST = "rest"
    SWEEP = "sweep"


class CalibrationProgress:
    """Calibration of one device, from the measurement until it is applied or discarded.

    Parameters
    ----------
    view : InputDeviceView
        The device, with the calibration in use.
    """

    def __init__(self, view: InputDeviceView) -> None:
        self.device = view.device
        self.calibration_in_use: InputCalibration = view.calibration
        # The calibration as changed by the operator, which is not in use yet.
        self.draft: InputCalibration = view.calibration
        # Why the latest measurement has left an axis unchanged, by axis.
        self.problems: Mapping[str, str] = {}
        self.step = CalibrationStep.EDIT
        self._run: StickCalibrationRun | None = None
        self._start_s = 0.0

    @property
    def is_changed(self) -> bool:
        """Whether the draft differs from the calibration in use."""
        return self.draft != self.calibration_in_use

    @property
    def measurable_axes(self) -> tuple[str, ...]:
        """The axes that are measured by default."""
        return tuple(axis for axis in self.device.axes if not _has_prefix(axis, _SWITCH_PREFIXES))

    @property
    def one_sided_axes(self) -> tuple[str, ...]:
        """The axes that rest at an end, according to their calibration or else to their name."""
        return tuple(axis for axis in self.device.axes if self._is_one_sided(axis))

    @property
    def ranges(self) -> Mapping[str, tuple[float, float]]:
        """The smallest and the largest reading of each axis in the current measurement."""
        return {} if self._run is None else self._run.ranges

    @property
    def open_problems(self) -> Mapping[str, str]:
        """The current problem of each axis during a measurement, by axis."""
        return {} if self._run is None else self._run.problems

    def begin(
        self,
        axes: Sequence[str],
        one_sided: Collection[str],
        last: InputReading | None,
        now_s: float,
    ) -> None:
        """Start a measurement. The device must not be touched from now on.

        Parameters
        ----------
        axes : sequence of str
            The axes to measure.
        one_sided : collection of str
            The axes that rest at an end.
        last : InputReading or None
            The latest reading of the device.
        now_s : float
            Host time, s.

        Raises
        ------
        InputCalibrationError
            If there is no axis to measure.
        """
        if not axes:
            raise InputCalibrationError(tr("no axis is chosen: choose the axes to measure"))
        measured_one_sided = [axis for axis in one_sided if axis in axes]
        self._run = StickCalibrationRun(self.device.axes, axes, measured_one_sided, last)
        self.step, self._start_s, self.problems = CalibrationStep.REST, now_s, {}

    def receive(self, readings: Sequence[InputReading]) -> None:
        """Add the readings that were taken since the start of the measurement."""
        if self._run is not None:
            for reading in readings:
                if reading.host_time_s >= self._start_s:
                    self._run.feed(reading)

    def compute_remaining_rest_s(self, now_s: float) -> float:
        """Return the remaining time for which the device must not be touched, s."""
        return (
            max(REST_DURATION_S - (now_s - self._start_s), 0.0)
            if self.step is CalibrationStep.REST
            else 0.0
        )

    def start_sweep(self) -> None:
        """Begin the step in which the operator moves the axes to their ends."""
        assert self._run is not None
        self._run.begin_sweep()
        self.step = CalibrationStep.SWEEP

    def finish(self) -> None:
        """Enter the successfully measured axes in the draft, and leave the others unchanged."""
        assert self._run is not None
        previous_calibrations = {axis: self.draft.find_axis(axis) for axis in self.device.axes}
        self.problems = self._run.problems
        self.draft = self.draft.with_axes(self._run.make_calibrations(previous_calibrations))
        self.cancel()

    def cancel(self) -> None:
        """Cancel the measurement."""
        self._run = None
        self.step = CalibrationStep.EDIT

    def discard(self) -> None:
        """Reset the draft to the calibration in use."""
        self.draft, self.problems = self.calibration_in_use, {}

    def change_axis(self, axis: str, **changes: float | bool | None) -> None:
        """Change settings of one axis in the draft.

        Raises
        ------
        InputCalibrationError
            If a setting is out of bounds or contradicts another one.
        """
        self.draft = self.draft.with_axes(
            {axis: with_settings(axis, self.draft.find_axis(axis), **changes)}
        )

    def reset_axis(self, axis: str) -> None:
        """Reset one axis in the draft to the settings of an uncalibrated axis."""
        axes = {name: settings for name, settings in self.draft.axes.items() if name != axis}
        self.draft = replace(self.draft, axes=axes)

    def _is_one_sided(self, axis: str) -> bool:
        if axis in self.calibration_in_use.axes:
            calibration = self.calibration_in_use.axes[axis]
            return calibration.centre in (calibration.low, calibration.high)
        return _has_prefix(axis, _TRIGGER_PREFIXES)


def with_settings(
    axis: str, calibration: InputAxisCalibration, **changes: float | bool | None
) -> InputAxisCalibration:
    """Return a calibration with some settings changed.

    Raises
    ------
    InputCalibrationError
        If a setting is out of bounds or contradicts another one.
    """
    try:
        return InputAxisCalibration(**{**asdict(calibration), **changes})
    except ValidationError as error:
        detail = error.errors()[0]
        setting = ".".join(map(str, detail["loc"])) or tr("its settings")
        reason = str(detail.get("ctx", {}).get("error", detail["msg"]))
        raise InputCalibrationError(
            tr("axis {axis}, {where}: {reason}").format(axis=axis, where=setting, reason=reason)
        ) from error


def describe_axis_calibration(calibration: InputAxisCalibration) -> str:
    """Return the ends and the rest position of an axis in one line of text."""
    rest_text = (
        tr("rests at an end")
        if calibration.centre in (calibration.low, calibration.high)
        else tr("rests at {centre:+.2f}").format(centre=calibration.centre)
    )
    return tr("{low:+.2f} to {high:+.2f}, {rest}").format(
        low=calibration.low, high=calibration.high, rest=rest_text
    )


def _has_prefix(axis: str, prefixes: tuple[str, ...]) -> bool:
    return axis.casefold().startswith(prefixes)
