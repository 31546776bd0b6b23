"""One connected input device: converts trusted readings to deflections and actions."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from rotemina.app.motion.inputs.axis_calibration import InputCalibration
from rotemina.app.motion.inputs.button_debounce import AxisThreshold, DebouncedButton
from rotemina.app.motion.inputs.input_trust import AxisTrust
from rotemina.app.motion.inputs.intent import OperatorAction
from rotemina.app.motion.inputs.profile import ActionMapping, DeviceMapping
from rotemina.app.motion.inputs.profile_check import PluggedDevice
from rotemina.app.motion.inputs.report_watch import MAX_SILENCE_S, ReportWatch
from rotemina.drivers.inputs import InputReading
from rotemina.sim.messages import message

#: Actions that work from every device, even if another operator drives or mappings are being made.
STOP_ACTIONS = frozenset({OperatorAction.STOP, OperatorAction.EMERGENCY_STOP})
#: Actions that last while their button is held. They are never reported as pressed.
HELD_ACTIONS = frozenset(
    {OperatorAction.CLUTCH, OperatorAction.DEAD_MAN, OperatorAction.FINE, OperatorAction.COARSE}
)


@dataclass(frozen=True, slots=True)
class InputAxisView:
    """State of one axis, for a live bar.

    Attributes
    ----------
    control : str
        Name of the axis on the device.
    raw : float or None
        Raw value; None if the device has not reported one.
    deflection : float
        Calibrated deflection, −1 to 1, even if the axis is not trusted.
    drives : str or None
        Coordinate or robot axis that the axis is mapped to.
    reason : str or None
        Message on why the axis is not trusted; None if it is trusted.
    """

    control: str
    raw: float | None
    deflection: float
    drives: str | None
    reason: str | None


class MappedDevice:
    """Input device with its calibration and its mapping.

    Parameters
    ----------
    device : PluggedDevice
    calibration : InputCalibration
    mapping : DeviceMapping or None
        Mapping, of which the device must have all controls. None if the profile does not map the
        device.
    latest_reading : InputReading, optional
        Latest reading, if the device was read before. A device that reports only changes may not
        repeat it.
    """

    def __init__(
        self,
        device: PluggedDevice,
        calibration: InputCalibration,
        mapping: DeviceMapping | None,
        latest_reading: InputReading | None = None,
    ) -> None:
        self.device = device
        self.mapping = mapping
        #: Latest reading; None if no reading is valid.
        self.latest_reading = latest_reading
        #: Why the device cannot be used; None if it can.
        self.problem: str | None = None
        #: Why the device was lost in the last step; None if it was not.
        self.loss_reason: str | None = None
        #: Actions pressed in the last step, and actions held.
        self.pressed: frozenset[OperatorAction] = frozenset()
        self.held: frozenset[OperatorAction] = frozenset()
        self._calibrations = {axis: calibration.find_axis(axis) for axis in device.axes}
        self._axis_trust = {axis: AxisTrust(self._calibrations[axis]) for axis in device.axes}
        self._raw_values: dict[str, float] = {}
        self._report_watch = ReportWatch(
            None if latest_reading is None else latest_reading.host_time_s
        )
        self._initial_readings = () if latest_reading is None else (latest_reading,)
        self._action_controls = (
            [] if mapping is None else [_ActionControl(action) for action in mapping.actions]
        )

    def step(self, readings: Sequence[InputReading], now_s: float) -> None:
        """Process the readings since the last step, oldest first, and advance to a time."""
        self._report_watch.begin(now_s)
        self.loss_reason = None
        pressed: set[OperatorAction] = set()
        for reading in self._initial_readings:
            pressed |= self._feed_reading(reading)
        self._initial_readings = ()
        for reading in readings:
            pressed |= self._feed_reading(reading)
            self._report_watch.receive(reading, now_s, at_rest=self._is_at_rest)
        for axis in self._axis_trust.values():
            axis.step(now_s)
        for action_control in self._action_controls:
            if action_control.button.step(now_s):
                pressed.add(action_control.action)
        self.pressed = frozenset(pressed - HELD_ACTIONS)
        self.held = frozenset(
            action_control.action
            for action_control in self._action_controls
            if action_control.button.is_held
        )

    def check_silence(self, now_s: float, *, while_moving: bool) -> None:
        """Release everything if the device has been silent for too long.

        Parameters
        ----------
        now_s : float
            Host time.
        while_moving : bool
            Whether an axis of the operator who uses the device is deflected.
        """
        silence_s = self._report_watch.compute_silence_s(now_s)
        if self.device.streams:
            if silence_s > MAX_SILENCE_S:
                self._release_all(_describe_stream_failure(MAX_SILENCE_S))
            return
        if self.mapping is None or not self._is_acting:
            return
        limit_s = self._report_watch.find_max_silence_s(self.mapping.when_silent)
        # If a stream of readings ends while the dead-man is held, the dead-man must not count as
        # held when the stream returns.
        if silence_s > limit_s and (while_moving or self._report_watch.is_repeating):
            self._release_all(
                _describe_stream_failure(limit_s)
                if limit_s <= MAX_SILENCE_S
                else _describe_stillness(limit_s)
            )

    def forget_held(self, reason: str) -> None:
        """Release everything that is held after readings were missed, except for stops."""
        self.pressed &= STOP_ACTIONS
        if self._is_acting or self.held:
            self._release_all(reason)

    def distrust_axes(self, reason: str) -> None:
        """Distrust all axes until they are at rest."""
        for axis in self._axis_trust.values():
            axis.distrust(reason)

    @property
    def has_mapped_axes(self) -> bool:
        """Whether an axis of the device is mapped."""
        return self.mapping is not None and bool(self.mapping.axes)

    @property
    def is_deflected(self) -> bool:
        """Whether a trusted axis of the device is deflected."""
        return any(self.deflections.values())

    @property
    def deflections(self) -> Mapping[str, float]:
        """Deflections of the trusted axes, by driven coordinate."""
        deflections: dict[str, float] = {}
        for mapping in self.mapping.axes if self.mapping is not None else ():
            if (
                self._axis_trust[mapping.control].reason is None
                and mapping.control in self._raw_values
            ):
                deflection = self._compute_deflection(mapping.control)
                deflections[mapping.drives] = -deflection if mapping.inverted else deflection
        return deflections

    def find_travel_m(self, drives: str) -> float | None:
        """Return the grip travel for a deflection of 1, m; None if it was not measured."""
        for mapping in self.mapping.axes if self.mapping is not None else ():
            if mapping.drives == drives:
                return self._calibrations[mapping.control].travel_m
        return None

    @property
    def axes(self) -> tuple[InputAxisView, ...]:
        """All axes, mapped or not, for live bars."""
        mappings = self.mapping.axes if self.mapping is not None else ()
        drives = {mapping.control: mapping.drives for mapping in mappings}
        return tuple(
            InputAxisView(
                axis,
                self._raw_values.get(axis),
                self._compute_deflection(axis) if axis in self._raw_values else 0.0,
                drives.get(axis),
                self.problem or trust.reason,
            )
            for axis, trust in self._axis_trust.items()
        )

    def _compute_deflection(self, axis: str) -> float:
        return self._calibrations[axis].compute_deflection(self._raw_values[axis])

    @property
    def _is_acting(self) -> bool:
        """Whether the device moves an axis, or holds an action that affects motion."""
        return self.is_deflected or any(
            action_control.button.is_held and action_control.action in HELD_ACTIONS
            for action_control in self._action_controls
        )

    @property
    def _is_at_rest(self) -> bool:
        """Whether all mapped axes are in their dead zones and no action is held."""
        mappings = self.mapping.axes if self.mapping is not None else ()
        return not any(
            action_control.button.is_held for action_control in self._action_controls
        ) and all(
            mapping.control in self._raw_values and self._compute_deflection(mapping.control) == 0.0
            for mapping in mappings
        )

    def _feed_reading(self, reading: InputReading) -> set[OperatorAction]:
        device = self.device
        if reading.fault is not None:
            self._release_all(reading.fault)
            return set()
        self.problem = None
        self.latest_reading = reading
        for axis, raw in zip(device.axes, reading.axes, strict=True):
            self._raw_values[axis] = raw
            self._axis_trust[axis].feed(reading.host_time_s, raw)
        buttons = dict(zip(device.buttons, reading.buttons, strict=True))
        return {
            action_control.action
            for action_control in self._action_controls
            if action_control.button.feed(
                reading.host_time_s, self._is_down(action_control, buttons)
            )
        }

    def _is_down(self, action_control: "_ActionControl", buttons: Mapping[str, bool]) -> bool:
        if action_control.threshold is None:
            return buttons[action_control.control]
        # An uncalibrated axis, such as a trigger, may never be in its dead zone. So its values only
        # need to be plausible.
        if not self._axis_trust[action_control.control].is_plausible:
            return False
        return action_control.threshold.feed(self._compute_deflection(action_control.control))

    def _release_all(self, reason: str) -> None:
        if self.problem is None:
            self.loss_reason = reason
        self.problem = reason
        self.latest_reading = None
        self.held = frozenset()
        for axis in self._axis_trust.values():
            axis.forget_reports(reason)
        if self.mapping is not None:
            self._action_controls = [_ActionControl(action) for action in self.mapping.actions]


def _describe_stream_failure(limit_s: float) -> str:
    return message(
        "engine",
        "silent: a streaming device has sent nothing for {limit} s and counts as released. Check "
        "its battery, radio link or cable; then release it and start again",
    ).fill(limit=limit_s)


def _describe_stillness(limit_s: float) -> str:
    return message(
        "engine",
        "silent for {limit} s while it moved something, so it counts as released: its link may "
        "have failed. Release it and start again, and move the stick a little at least every "
        "{limit} s; or choose under Set up, Mapping that it continues while silent",
    ).fill(limit=limit_s)


class _ActionControl:
    def __init__(self, mapping: ActionMapping) -> None:
        self.control = mapping.control
        self.action = mapping.action
        self.button = DebouncedButton(counts_from_start=mapping.action in STOP_ACTIONS)
        self.threshold: AxisThreshold | None = None
        if mapping.at is not None:
            self.threshold = AxisThreshold(mapping.at, mapping.hysteresis)
