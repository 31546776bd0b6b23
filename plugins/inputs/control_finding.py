"""*Move it now*: finds the moved control of a device for one row of the mapping."""

from rotemina.app.motion.teleoperation.input_arbiter import DeviceView
from rotemina.app.motion.teleoperation.input_devices import InputSnapshot
from rotemina.app.motion.teleoperation.moved_control import Detection, Findings, Kind
from rotemina.plugins.inputs import tr

BUTTON_WAIT_S = 0.3  # a trigger tells its way first, and that it is pressed a moment later


class Finding:
    """Waits for one control to be moved.

    Parameters
    ----------
    view : DeviceView
        The device; what it said last is where its controls stand.
    axis : bool
        Whether it must be an axis. Otherwise a button goes before an axis: the trigger of many a
        gamepad is both.
    """

    def __init__(self, view: DeviceView, *, axis: bool) -> None:
        self._key = view.device.identity.key
        kinds = (Kind.AXIS,) if axis else (Kind.BUTTON, Kind.AXIS)
        self._detections = {kind: Detection([view.device], kind) for kind in kinds}
        self._axis_since_s: float | None = None
        self._view = view
        self._newest = view.newest
        if view.newest is not None:
            for detection in self._detections.values():
                detection.feed(self._key, view.newest)

    def receive(self, snapshot: InputSnapshot) -> None:
        """Take in what a step has read; what was said before is known already."""
        for reading in snapshot.readings.get(self._key, ()):
            if self._newest is not None and reading.host_time_s < self._newest.host_time_s:
                continue
            self._newest = reading
            for detection in self._detections.values():
                detection.feed(self._key, reading)

    def look(self, now_s: float) -> Findings:
        """Return what was moved, once that is sure."""
        found = {kind: self._found(kind, now_s) for kind in self._detections}
        button = found.get(Kind.BUTTON)
        if button is None:
            return found[Kind.AXIS]
        axis = found[Kind.AXIS]
        if button.detected is not None or axis.detected is None:
            self._axis_since_s = None
            return button if button.detected is not None else _both(button, axis)
        if self._axis_since_s is None:
            self._axis_since_s = now_s
        return axis if now_s - self._axis_since_s >= BUTTON_WAIT_S else Findings(None, axis.message)

    def _found(self, kind: Kind, now_s: float) -> Findings:
        """Return what was moved; an axis that has come back to its rest was let go."""
        found = self._detections[kind].findings(now_s)
        if kind is Kind.BUTTON or found.detected is None or self._newest is None:
            return found
        control = found.detected.control
        raw = self._newest.axes[self._view.device.axes.index(control)]
        at_rest = self._view.calibration.axis(control).deflection(raw) == 0.0
        return Findings(None, tr("move the axis now")) if at_rest else found


def _both(button: Findings, axis: Findings) -> Findings:
    """Return what there is to say while nothing was found: that several moved, if they did."""
    for one in (button, axis):
        if "together" in one.message:
            return one
    return Findings(None, tr("press the button, or move the axis, now"))
