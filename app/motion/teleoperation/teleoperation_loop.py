"""The teleoperation loop, which converts the operator's intents to axis speeds with a lease."""

import threading
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from math import isfinite, nan

from rotemina.app.errors import RequestRefusedError
from rotemina.app.motion.device import OPERATOR
from rotemina.app.motion.inputs import DEGREES_OF_FREEDOM, Intent, OperatorAction
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import SessionState
from rotemina.app.motion.teleoperation.frames import AxesFrame, FrameCoordinate, SteeringFrame
from rotemina.app.motion.teleoperation.modes import SteeringModes
from rotemina.app.motion.teleoperation.scales import LawKind, ModeScales
from rotemina.app.motion.teleoperation.scaling import (
    COARSE_FACTOR,
    FINE_FACTOR,
    ScalingLaw,
    find_next_preset,
)
from rotemina.app.motion.teleoperation.speed_following import LearnedLag, ReferenceFollower
from rotemina.app.motion.teleoperation.steering import FrameSteering
from rotemina.app.motion.teleoperation.teleoperation_state import (
    TeleoperationState,
    make_display_values,
)
from rotemina.drivers.abilities import VelocityMover
from rotemina.drivers.contract import DeviceState
from rotemina.sim.errors import InputError
from rotemina.sim.messages import AxisName, FieldList, marked, message
from rotemina.sim.trajectory import get_command_resolution

# Owner of the axes that the joystick moves.
JOYSTICK_OWNER = "joystick"
SPEED_LEASE_S = 0.15
# An unchanged speed is sent again at this period.
_SPEED_RENEWAL_S = 0.04
# A change of speed waits for the next renewal if it is below the sum of this fraction of the speed
# and this many resolutions of the axis per second.
_DEFERRABLE_SPEED_RATIO, _DEFERRABLE_RESOLUTIONS_PER_S = 0.02, 10.0
# A late step advances by at most this time, so that the motion does not jump.
_MAX_STEP_S = 0.05
# A deviation within this many noise floors of the sensor does not count as a contact.
_CONTACT_DEAD_BAND_RATIO = 3.0
_STOPPING_REASON = message("engine", "the machine is being stopped")
# Name of the mode for axes that a control drives by the name of the axis.
DIRECT_MODE = "direct"


@dataclass(slots=True)
class _SteeringChannel:
    steering: FrameSteering
    follower: ReferenceFollower
    sent_speeds: Mapping[str, float] = field(default_factory=dict)
    sent_s: float = float("-inf")
    # Whether the latest speeds were refused. Then the axes may be away from the reference.
    was_refused: bool = False


class Teleoperator:
    """Moves the axes of a session according to the operator's intents.

    One thread calls :meth:`step` at about 200 Hz. All motion goes through
    :meth:`MotionSession.move_velocity`, so ranges, keep-out zones, leases and owners apply. If
    anything else has moved the machine, the reference starts again from the machine's position.

    Requests (``use_mode``, ``use_law``, …) may come from any thread and act in the next step.

    Parameters
    ----------
    session : MotionSession
    scales : ModeScales, optional
    """

    def __init__(self, session: MotionSession, scales: ModeScales | None = None) -> None:
        self.modes = SteeringModes(session.robot)
        self._session = session
        self._robot = session.robot
        #: Motion of the coordinates for full deflection of a stick.
        self.scales = ModeScales() if scales is None else scales
        self._mode = self.modes.names[0]
        self._law = LawKind.RATE
        self._preset = 1.0
        self._channels: dict[str, _SteeringChannel] = {}
        self._last_step_s: float | None = None
        # Permit of the latest step.
        self._permit = session.permit()
        self._refusal_reason: str | None = None
        self._idle_reason: str | None = None
        self._intent = Intent(0.0)
        self._reactions: dict[str, float] = {}
        self._lag = LearnedLag()
        self._requests: list[Callable[[], None]] = []
        # Guards the requests.
        self._lock = threading.Lock()
        self.state = TeleoperationState(self._mode, self._law)

    def use_mode(self, name: str) -> None:
        """Steer in another mode, also during a motion, without a jump.

        Raises
        ------
        RequestRefusedError
            If the robot does not have the mode.
        """
        if name not in self.modes.names:
            raise RequestRefusedError(
                "there is no mode {name}; use {names}",
                name=repr(name),
                names=", ".join(self.modes.names),
            )
        self._add_request(lambda: self._change_mode(name))

    def use_law(self, kind: LawKind) -> None:
        """Scale by another law, also during a motion, without a jump."""
        self._add_request(lambda: self._change_law(kind))

    def use_preset(self, factor: float) -> None:
        """Multiply every scale by a step preset, also during a motion."""

        def change() -> None:
            self._preset = factor

        self._add_request(change)

    def use_scales(self, scales: ModeScales) -> None:
        """Use other scales; moving axes come to rest first.

        Raises
        ------
        ScalingError
            If a coordinate of the current mode is too slow for its scale.
        """
        frame = self._find_frame()
        if frame is not None:
            for coordinate in frame.coordinates.values():
                for kind in LawKind:
                    scales.find_scale(frame.name, coordinate).make_law(kind, coordinate, 0.0)

        def change() -> None:
            self.scales = scales
            self._release_axes(
                marked("engine", "the scales were changed") if self.state.is_driving else None
            )

        self._add_request(change)

    def step(self, intent: Intent, now_s: float) -> None:
        """Act on an intent, without waiting."""
        dt = min(max(now_s - (self._last_step_s or now_s), 0.0), _MAX_STEP_S)
        self._last_step_s, self._intent = now_s, intent
        stop_reason = self._stop_if_requested(intent)
        self._apply_requests(intent)
        previous_permit, self._permit = self._permit, self._session.permit()
        state = self._session.snapshot()
        self._idle_reason = stop_reason or self._find_idle_reason(state, intent)
        # The state does not show a stop that begins and ends between two steps, or that finds all
        # axes at rest.
        if previous_permit.epoch != self._permit.epoch:
            self._idle_reason = self._idle_reason or _STOPPING_REASON
        if self._idle_reason is not None:
            self._release_axes(None)
        else:
            self._steer(intent, state, now_s, dt)
        channel = self._channels.get(self._mode)
        self.state = TeleoperationState(
            self._mode,
            self._law,
            self._preset,
            self._compute_factor(intent),
            any(
                any(active_channel.sent_speeds.values())
                for active_channel in self._channels.values()
            ),
            self._idle_reason,
            self._refusal_reason,
            *(
                ()
                if channel is None
                else make_display_values(channel.steering, intent.deflections, self._reactions)
            ),
        )

    def _stop_if_requested(self, intent: Intent) -> str | None:
        """Stop if a stop was requested or the driving device was lost; return the reason."""
        if OperatorAction.EMERGENCY_STOP in intent.pressed:
            self._session.emergency_stop(
                message("engine", "the joystick's stop and lock"), by=OPERATOR
            )
        elif OperatorAction.STOP in intent.pressed:
            self._session.stop(message("engine", "the joystick's stop"), by=OPERATOR)
        elif intent.loss_reason is not None and self.state.is_driving:
            self._session.stop(intent.loss_reason)
        else:
            return None
        self._refusal_reason = intent.loss_reason
        return _STOPPING_REASON

    def _apply_requests(self, intent: Intent) -> None:
        with self._lock:
            requests, self._requests = self._requests, []
        if OperatorAction.STAGE in intent.pressed:
            requests.append(lambda: self._change_mode(self.modes.find_next(self._mode)))
        if OperatorAction.LAW in intent.pressed:
            requests.append(lambda: self._change_law(self._law.next))
        if OperatorAction.STEP_PRESET in intent.pressed:
            self._preset = find_next_preset(self._preset)
        for request in requests:
            try:
                request()
            except InputError as error:
                self._refusal_reason = str(error)

    def _find_idle_reason(self, state: SessionState, intent: Intent) -> str | None:
        if state.lock_reason is not None:
            return state.lock_reason
        if state.stopping:
            return _STOPPING_REASON
        if state.activity in (DeviceState.PLAYING, DeviceState.HOMING):
            return message("engine", "the machine is {activity}").fill(activity=state.activity)
        if not isinstance(self._session.driver, VelocityMover):
            return message("engine", "driver {driver} cannot move at a set speed").fill(
                driver=repr(self._session.driver.name)
            )
        if not intent.deflections and not self.state.is_driving:
            return message(
                "engine",
                "no stick is active: release it, and hold its dead-man button if it has one",
            )
        other_owners = {owner for owner in state.owners.values() if owner != JOYSTICK_OWNER}
        if state.activity is DeviceState.MOVING and other_owners and not self.state.is_driving:
            return message("engine", "axes are moved by {owner}").fill(
                owner=FieldList(tuple(sorted(other_owners)))
            )
        return None

    def _steer(self, intent: Intent, state: SessionState, now_s: float, dt: float) -> None:
        factor = self._compute_factor(intent)
        try:
            channels = self._update_channels(intent, state)
            for channel in channels:
                channel.steering.rescale(factor)
        except InputError as error:
            self._release_axes(str(error))
            return
        for channel in channels:
            steering, is_driving = channel.steering, any(channel.sent_speeds.values())
            previous = steering.coordinates
            targets = steering.step(
                intent.deflections,
                dt,
                is_coupled=OperatorAction.CLUTCH not in intent.held,
                reactions=self._measure_reactions(steering.frame, state),
            )
            channel.follower.note_reference(now_s, targets.joints)
            speeds = channel.follower.compute_speeds(targets.speeds, state, is_driving)
            self._send_speeds(channel, previous, speeds, now_s, state)

    def _send_speeds(
        self,
        channel: _SteeringChannel,
        previous: Mapping[str, float],
        speeds: Mapping[str, float],
        now_s: float,
        state: SessionState,
    ) -> None:
        # A speed of 0 is sent only once. After that the axis is free for other owners.
        speeds = {
            axis: speed for axis, speed in speeds.items() if speed or channel.sent_speeds.get(axis)
        }
        if not speeds or (
            now_s - channel.sent_s < _SPEED_RENEWAL_S
            and self._can_wait_for_renewal(speeds, channel.sent_speeds)
        ):
            return
        lost_axis = channel.follower.find_lost_axis(speeds, state)
        if lost_axis is not None:
            self._release_axes(
                message("engine", "axis {axis} does not follow the stick").fill(
                    axis=AxisName(lost_axis)
                )
            )
            return
        try:
            used_speeds = self._session.move_velocity(
                speeds, SPEED_LEASE_S, JOYSTICK_OWNER, permit=self._permit
            )
        except InputError as error:
            # After a stop, the next step shows the reason.
            if not self._permit.is_valid:
                self._release_axes(None)
                return
            self._refusal_reason = str(error)
            channel.steering.hold_at_fraction(previous, 0.0)
            channel.follower.forget_reference()
            channel.sent_speeds, channel.was_refused = {}, True
            return
        channel.sent_speeds, channel.sent_s, channel.was_refused = dict(speeds), now_s, False
        speed_ratio = _find_speed_ratio(speeds, used_speeds)
        self._refusal_reason = None
        if speed_ratio < 1.0:
            self._refusal_reason = message("engine", "slowed: the tip is close to its bounds")
            channel.steering.hold_at_fraction(previous, speed_ratio)
            channel.follower.forget_reference()

    def _can_wait_for_renewal(
        self, speeds: Mapping[str, float], sent_speeds: Mapping[str, float]
    ) -> bool:
        """Return whether speeds are close enough to those sent to wait for the next renewal.

        If every small change were sent, the line would be busy and important commands would wait.
        """
        if speeds.keys() != sent_speeds.keys():
            return False
        return all(
            (speed == 0.0) == (sent_speeds[axis] == 0.0)
            and abs(speed - sent_speeds[axis])
            <= _DEFERRABLE_SPEED_RATIO * abs(sent_speeds[axis])
            + _DEFERRABLE_RESOLUTIONS_PER_S * get_command_resolution(self._robot.axes[axis])
            for axis, speed in speeds.items()
        )

    def _is_away_from_reference(self, channel: _SteeringChannel, state: SessionState) -> bool:
        if (
            any(channel.sent_speeds.values())
            or state.activity is not DeviceState.IDLE
            or state.queued
        ):
            return False
        targets = channel.steering.compute_targets().joints
        return any(
            abs(state.command.get(axis, target) - target) > self._find_tolerance(axis)
            for axis, target in targets.items()
        )

    def _update_channels(self, intent: Intent, state: SessionState) -> tuple[_SteeringChannel, ...]:
        """Return the active channels. New channels begin at the position of the machine."""
        for name, channel in tuple(self._channels.items()):
            if not self._is_away_from_reference(channel, state):
                continue
            del self._channels[name]
            # A stick that was centred in the latest step acts at once.
            if channel.was_refused or channel.steering.is_released:
                axes = channel.steering.frame.axes
                new_channel = self._make_channel(
                    self._begin_frame(name, axes, state), self._law, engaged=True
                )
                new_channel.steering.begin(new_channel.steering.frame.start, {}, intent.deflections)
                self._channels[name] = new_channel
        if self._mode not in self._channels:
            self._channels[self._mode] = self._make_channel(
                self._begin_frame(self._mode, (), state), self._law
            )
        mode_axes = self._channels[self._mode].steering.frame.axes
        direct_axes = tuple(
            axis
            for axis in self._robot.axes
            if axis in intent.deflections and axis not in (*DEGREES_OF_FREEDOM, *mode_axes)
        )
        if direct_axes and DIRECT_MODE not in self._channels:
            self._channels[DIRECT_MODE] = self._make_channel(
                self._begin_frame(DIRECT_MODE, direct_axes, state), self._law
            )
        return tuple(
            self._channels[name] for name in (self._mode, DIRECT_MODE) if name in self._channels
        )

    def _begin_frame(self, name: str, axes: tuple[str, ...], state: SessionState) -> SteeringFrame:
        """Return the frame of a mode, which begins at the position of the machine.

        ``axes`` are the axes of the direct mode.
        """
        if name == DIRECT_MODE:
            return AxesFrame(self._robot, DIRECT_MODE, axes, state.command)
        return self.modes.begin_mode(name, state.command)

    def _make_channel(
        self, frame: SteeringFrame, kind: LawKind, *, engaged: bool = False
    ) -> _SteeringChannel:
        def make_law(coordinate: FrameCoordinate) -> ScalingLaw:
            scale = self.scales.find_scale(frame.name, coordinate)
            return scale.make_law(kind, coordinate, self._find_contact_noise(coordinate))

        return _SteeringChannel(
            FrameSteering(frame, kind, make_law, engaged=engaged),
            ReferenceFollower(self._robot, self._lag),
        )

    def _change_mode(self, name: str) -> None:
        """Begin another mode at the current reference, and halt axes that it does not move."""
        previous_channel = self._channels.get(self._mode)
        if name == self._mode or previous_channel is None:
            self._mode = name
            return
        targets = previous_channel.steering.compute_targets()
        joints = {**self._session.snapshot().command, **targets.joints}
        channel = self._make_channel(self.modes.begin_mode(name, joints), self._law)
        velocities = channel.steering.frame.compute_coordinate_speeds(targets.speeds)
        self._mode = name
        del self._channels[previous_channel.steering.frame.name]
        self._drop_channels()
        channel.steering.begin(channel.steering.frame.start, velocities, self._intent.deflections)
        self._channels[name] = channel
        self._halt_axes(
            axis for axis in previous_channel.sent_speeds if axis not in channel.steering.frame.axes
        )
        channel.sent_speeds = {
            axis: previous_channel.sent_speeds.get(axis, 0.0)
            for axis in channel.steering.frame.axes
        }

    def _change_law(self, kind: LawKind) -> None:
        channels = {}
        for name, previous_channel in self._channels.items():
            channel = self._make_channel(previous_channel.steering.frame, kind, engaged=True)
            channel.steering.rescale(self._compute_factor(self._intent))
            steering = previous_channel.steering
            channel.steering.begin(
                steering.coordinates, steering.velocities, self._intent.deflections
            )
            channels[name] = replace(
                channel,
                follower=previous_channel.follower,
                sent_speeds=previous_channel.sent_speeds,
            )
        self._law, self._channels = kind, channels

    def _release_axes(self, reason: str | None) -> None:
        """Halt the moving axes. Steering then starts again from the position of the machine."""
        if reason is not None:
            self._refusal_reason = reason
        self._drop_channels()

    def _drop_channels(self) -> None:
        for channel in tuple(self._channels.values()):
            self._halt_axes(axis for axis, speed in channel.sent_speeds.items() if speed)
        self._channels.clear()

    def _halt_axes(self, axes: Iterable[str]) -> None:
        speeds = dict.fromkeys(axes, 0.0)
        if speeds:
            # After a refusal the joystick no longer moves these axes. Their leases expire in any
            # case.
            with suppress(InputError):
                self._session.move_velocity(speeds, SPEED_LEASE_S, JOYSTICK_OWNER)

    def _add_request(self, change: Callable[[], None]) -> None:
        with self._lock:
            self._requests.append(change)

    def _find_frame(self) -> SteeringFrame | None:
        channel = self._channels.get(self._mode)
        return None if channel is None else channel.steering.frame

    def _compute_factor(self, intent: Intent) -> float:
        factor = self._preset
        if OperatorAction.FINE in intent.held:
            factor *= FINE_FACTOR
        if OperatorAction.COARSE in intent.held:
            factor *= COARSE_FACTOR
        return factor

    def _measure_reactions(self, frame: SteeringFrame, state: SessionState) -> dict[str, float]:
        """Return the contact signal of each coordinate: its deviation from the nominal model."""
        if self._law is not LawKind.IMPEDANCE:
            return {}
        deviations = {
            # Use the nominal model, because the model in use may have learned the contact.
            axis: state.measured[axis] - state.nominal[axis]
            for axis in frame.axes
            if axis in state.measured and isfinite(state.nominal.get(axis, nan))
        }
        self._reactions = frame.compute_coordinate_speeds(deviations)
        return self._reactions

    def _find_contact_noise(self, coordinate: FrameCoordinate) -> float:
        """Return the largest deviation of a coordinate that does not count as a contact."""
        noise_floors = [
            axis.sensor.noise_floor
            for axis in self._robot.axes.values()
            if axis.sensor is not None and axis.unit == coordinate.unit
        ]
        return _CONTACT_DEAD_BAND_RATIO * max(noise_floors, default=0.0)

    def _find_tolerance(self, axis: str) -> float:
        return 2.0 * max(
            get_command_resolution(self._robot.axes[axis]), 1e-6 * self._robot.axes[axis].span
        )


def _find_speed_ratio(requested: Mapping[str, float], used: Mapping[str, float]) -> float:
    ratios = [used.get(axis, speed) / speed for axis, speed in requested.items() if speed]
    return min(ratios, default=1.0)
