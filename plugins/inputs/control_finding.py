"""Finds the control to be assigned to a function, by asking the operator to move it."""

from rotemina.app.motion.inputs import (
    ControlDetector,
    ControlKind,
    DetectionResult,
    InputDeviceView,
    InputSnapshot,
)
from rotemina.plugins.inputs import tr

# A moved axis is accepted only after this time. The trigger of a gamepad first reports its travel
# as an axis, and only a moment later its press as a button.
BUTTON_WAIT_S = 0.3


class ControlFinder:
    """Finds the one control of a device that the operator moves.

    Parameters
    ----------
    view : InputDeviceView
        The device. Its latest reading gives the initial positions of the controls.
    axis : bool
        Whether only axes are accepted. Otherwise a button takes precedence over an axis, because
        the triggers of many gamepads are both.
    """

    def __init__(self, view: InputDeviceView, *, axis: bool) -> None:
        self._key = view.device.identity.key
        kinds = (ControlKind.AXIS,) if axis else (ControlKind.BUTTON, ControlKind.AXIS)
        self._detectors = {kind: ControlDetector([view.device], kind) for kind in kinds}
        # When a moved axis was first found; None if none has been found.
        self._axis_found_s: float | None = None
        self._view = view
        self._latest_reading = view.latest_reading
        if view.latest_reading is not None:
            for detector in self._detectors.values():
                detector.feed(self._key, view.latest_reading)

    def receive(self, snapshot: InputSnapshot) -> None:
        """Add the new readings of the device, except those older than the latest one."""
        for reading in snapshot.readings.get(self._key, ()):
            if (
                self._latest_reading is not None
                and reading.host_time_s < self._latest_reading.host_time_s
            ):
                continue
            self._latest_reading = reading
            for detector in self._detectors.values():
                detector.feed(self._key, reading)

    def find_control(self, now_s: float) -> DetectionResult:
        """Return the moved control, or a message to the operator if none has been found.

        ``now_s`` is the host time, s.
        """
        results = {kind: self._find_kind(kind, now_s) for kind in self._detectors}
        button_result = results.get(ControlKind.BUTTON)
        if button_result is None:
            return results[ControlKind.AXIS]
        axis_result = results[ControlKind.AXIS]
        if button_result.moved_control is not None:
            self._axis_found_s = None
            return button_result
        if axis_result.moved_control is None:
            self._axis_found_s = None
            return _merge_messages(button_result, axis_result)
        if self._axis_found_s is None:
            self._axis_found_s = now_s
        return (
            axis_result
            if now_s - self._axis_found_s >= BUTTON_WAIT_S
            else DetectionResult(None, axis_result.message)
        )

    def _find_kind(self, kind: ControlKind, now_s: float) -> DetectionResult:
        """Return the moved control of one kind, but not an axis that is back at rest."""
        result = self._detectors[kind].find_moved_control(now_s)
        if (
            kind is ControlKind.BUTTON
            or result.moved_control is None
            or self._latest_reading is None
        ):
            return result
        control = result.moved_control.control
        raw = self._latest_reading.axes[self._view.device.axes.index(control)]
        is_at_rest = self._view.calibration.find_axis(control).compute_deflection(raw) == 0.0
        return DetectionResult(None, tr("move the axis now")) if is_at_rest else result


def _merge_messages(
    button_result: DetectionResult, axis_result: DetectionResult
) -> DetectionResult:
    """Return a result without a control, with one message for buttons and axes.

    If several controls moved at once, the message that says so takes precedence.
    """
    for result in (button_result, axis_result):
        if result.is_ambiguous:
            return result
    return DetectionResult(None, tr("press the button, or move the axis, now"))
