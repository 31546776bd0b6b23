"""The teleoperation loop: converts an operator's intents to leased axis speeds."""

import threading
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from math import isfinite, nan

from rotemina.app.motion.mailbox import RefusedError
from rotemina.app.motion.ownership import OPERATOR
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import SessionState
from rotemina.app.motion.teleoperation.frames import AxesFrame, Coordinate, Frame
from rotemina.app.motion.teleoperation.intent import Action, Intent
from rotemina.app.motion.teleoperation.modes import Modes
from rotemina.app.motion.teleoperation.profile_check import DEGREES_OF_FREEDOM
from rotemina.app.motion.teleoperation.scales import LawKind, Scales
from rotemina.app.motion.teleoperation.scaling import COARSE, FINE, ScalingLaw, next_preset
from rotemina.app.motion.teleoperation.speed_following import Following, Lag
from rotemina.app.motion.teleoperation.steering import Steering
from rotemina.app.motion.teleoperation.teleoperation_state import TeleoperationState, shown
from rotemina.drivers.abilities import VelocityMover
from rotemina.drivers.samples import DeviceState
from rotemina.sim.errors import InputError
from rotemina.sim.messages import AxisName, Listed, marked, message
from rotemina.sim.trajectory.axis_limits import resolution_of

JOYSTICK = "joystick"  # the owner of the axes that it moves
LEASE_S = 0.15
_RENEW_S = 0.04  # a speed that does not change is said again this often
_NEARLY, _STEPS_S = 0.02, 10.0  # of a speed, and resolutions a second: changes that can wait
_LONGEST_STEP_S = 0.05  # a loop that was late does not make up for it
_NOISE_FLOORS = 3.0  # of a deviation, that are no contact
_STOPPED = message("engine", "the machine is being stopped")
DIRECT = "direct"  # axes that a control drives by their own name


@dataclass(slots=True)
class _Channel:
    """A steering with what it was sent last."""

    steering: Steering
    following: Following
    sent: Mapping[str, float] = field(default_factory=dict)
    sent_s: float = float("-inf")
    refused: bool = False  # its axes may be elsewhere by that, and not because others moved them


class Teleoperator:
    """Steers a session's axes by intents; stepped at about 200 Hz by one thread.

    Whatever it moves goes through :meth:`MotionSession.move_velocity`: ranges, keep-out, leases and
    owners hold. It is anchored where the machine stands whenever anything else has moved it.

    Requests (``use_mode``, ``use_law``, …) may come from any thread and act with the next step.

    Parameters
    ----------
    session : MotionSession
    scales : Scales
    """

    def __init__(self, session: MotionSession, scales: Scales | None = None) -> None:
        self.modes = Modes(session.robot)
        self._session = session
        self._robot = session.robot
        #: How far and fast sticks move the coordinates.
        self.scales = Scales() if scales is None else scales
        self._mode = self.modes.names[0]
        self._law = LawKind.RATE
        self._preset = 1.0
        self._channels: dict[str, _Channel] = {}
        self._before_s: float | None = None
        self._permit = session.permit()  # of the latest step
        self._refused: str | None = None
        self._reason: str | None = None
        self._intent = Intent(0.0)
        self._reactions: dict[str, float] = {}
        self._lag = Lag()
        self._requests: list[Callable[[], None]] = []
        self._lock = threading.Lock()  # guards the requests
        self.state = TeleoperationState(self._mode, self._law)

    # --- requests ---------------------------------------------------------------------------------

    def use_mode(self, name: str) -> None:
        """Steer in another mode; also in mid-move, without a jump.

        Raises
        ------
        RefusedError
            If the robot has no such mode.
        """
        if name not in self.modes.names:
            raise RefusedError(
                message("engine", "there is no mode {name}; use {names}").fill(
                    name=repr(name), names=", ".join(self.modes.names)
                )
            )
        self._request(lambda: self._change_mode(name))

    def use_law(self, kind: LawKind) -> None:
        """Scale by another law; also in mid-move, without a jump."""
        self._request(lambda: self._change_law(kind))

    def use_preset(self, factor: float) -> None:
        """Multiply every scale by a step preset; also in mid-move."""

        def change() -> None:
            self._preset = factor

        self._request(change)

    def use_scales(self, scales: Scales) -> None:
        """Use other scales; what moves comes to rest first.

        Raises
        ------
        ScalingError
            If a coordinate of the present mode cannot do what they ask for.
        """
        frame = self._frame()
        if frame is not None:
            for coordinate in frame.coordinates.values():
                for kind in LawKind:
                    scales.of(frame.name, coordinate).law(kind, coordinate, 0.0)

        def change() -> None:
            self.scales = scales
            self._release_axes(
                marked("engine", "the scales were changed") if self.state.driving else None
            )

        self._request(change)

    # --- the loop ---------------------------------------------------------------------------------

    def step(self, intent: Intent, now_s: float) -> None:
        """Execute an intent; never waits."""
        dt = min(max(now_s - (self._before_s or now_s), 0.0), _LONGEST_STEP_S)
        self._before_s, self._intent = now_s, intent
        stopped = self._stop_if_asked(intent)
        self._take_requests(intent)
        before, self._permit = self._permit, self._session.permit()
        state = self._session.snapshot()
        self._reason = stopped or self._why_not(state, intent)
        # A stop may come and be over between two looks, or find everything at rest.
        if before.epoch != self._permit.epoch:
            self._reason = self._reason or _STOPPED
        if self._reason is not None:
            self._release_axes(None)
        else:
            self._steer(intent, state, now_s, dt)
        channel = self._channels.get(self._mode)
        self.state = TeleoperationState(
            self._mode,
            self._law,
            self._preset,
            self._factor(intent),
            any(any(one.sent.values()) for one in self._channels.values()),
            self._reason,
            self._refused,
            *(
                ()
                if channel is None
                else shown(channel.steering, intent.deflections, self._reactions)
            ),
        )

    def _stop_if_asked(self, intent: Intent) -> str | None:
        """Stop where that is requested, or what drove is gone; return why nothing is to move."""
        if Action.EMERGENCY_STOP in intent.pressed:
            self._session.emergency_stop(
                message("engine", "the joystick's stop and lock"), by=OPERATOR
            )
        elif Action.STOP in intent.pressed:
            self._session.stop(message("engine", "the joystick's stop"), by=OPERATOR)
        elif intent.lost is not None and self.state.driving:
            self._session.stop(intent.lost)
        else:
            return None
        self._refused = intent.lost
        return _STOPPED

    def _take_requests(self, intent: Intent) -> None:
        with self._lock:
            requests, self._requests = self._requests, []
        if Action.STAGE in intent.pressed:
            requests.append(lambda: self._change_mode(self.modes.after(self._mode)))
        if Action.LAW in intent.pressed:
            requests.append(lambda: self._change_law(self._law.next))
        if Action.STEP_PRESET in intent.pressed:
            self._preset = next_preset(self._preset)
        for request in requests:
            try:
                request()
            except InputError as error:
                self._refused = str(error)

    def _why_not(self, state: SessionState, intent: Intent) -> str | None:
        if state.locked is not None:
            return state.locked
        if state.stopping:
            return _STOPPED
        if state.activity in (DeviceState.PLAYING, DeviceState.HOMING):
            return message("engine", "the machine is {activity}").fill(activity=state.activity)
        if not isinstance(self._session.driver, VelocityMover):
            return message("engine", "driver {driver} cannot move at a set speed").fill(
                driver=repr(self._session.driver.name)
            )
        if not intent.deflections and not self.state.driving:
            return message(
                "engine",
                "no stick is active: release it, and hold its dead-man button if it has one",
            )
        others = {owner for owner in state.owners.values() if owner != JOYSTICK}
        if state.activity is DeviceState.MOVING and others and not self.state.driving:
            return message("engine", "axes are moved by {owner}").fill(
                owner=Listed(tuple(sorted(others)))
            )
        return None

    def _steer(self, intent: Intent, state: SessionState, now_s: float, dt: float) -> None:
        factor = self._factor(intent)
        try:
            channels = self._channels_for(intent, state)
            for channel in channels:
                channel.steering.rescale(factor)
        except InputError as error:
            self._release_axes(str(error))
            return
        for channel in channels:
            steering, driving = channel.steering, any(channel.sent.values())
            before = steering.coordinates
            wanted = steering.step(
                intent.deflections,
                dt,
                free=Action.CLUTCH not in intent.held,
                reactions=self._felt(steering.frame, state),
            )
            channel.following.wanted(now_s, wanted.joints)
            speeds = channel.following.speeds(wanted.speeds, state, driving)
            self._send(channel, before, speeds, now_s, state)

    def _send(
        self,
        channel: _Channel,
        before: Mapping[str, float],
        speeds: Mapping[str, float],
        now_s: float,
        state: SessionState,
    ) -> None:
        # An axis that rests is nobody's: somebody else may move it meanwhile.
        speeds = {axis: v for axis, v in speeds.items() if v or channel.sent.get(axis)}
        if not speeds or (
            now_s - channel.sent_s < _RENEW_S and self._as_sent(speeds, channel.sent)
        ):
            return
        lost = channel.following.lost(speeds, state)
        if lost is not None:
            self._release_axes(
                message("engine", "axis {axis} does not follow the stick").fill(axis=AxisName(lost))
            )
            return
        try:
            used = self._session.move_velocity(speeds, LEASE_S, JOYSTICK, permit=self._permit)
        except InputError as error:
            if not self._permit.valid:  # the next step says that a stop has come
                self._release_axes(None)
                return
            self._refused = str(error)
            channel.steering.hold_back(before, 0.0)
            channel.following.forget()
            channel.sent, channel.refused = {}, True
            return
        channel.sent, channel.sent_s, channel.refused = dict(speeds), now_s, False
        share = _share(speeds, used)
        self._refused = None
        if share < 1.0:
            self._refused = message("engine", "slowed: the tip is close to its bounds")
            channel.steering.hold_back(before, share)
            channel.following.forget()

    def _as_sent(self, speeds: Mapping[str, float], sent: Mapping[str, float]) -> bool:
        """Whether speeds are so near to those sent that they may wait for the next renewal.

        What follows every rounding would keep the line busy, and what matters would wait.
        """
        if speeds.keys() != sent.keys():
            return False
        return all(
            (speed == 0.0) == (sent[axis] == 0.0)
            and abs(speed - sent[axis])
            <= _NEARLY * abs(sent[axis]) + _STEPS_S * resolution_of(self._robot.axes[axis])
            for axis, speed in speeds.items()
        )

    def _elsewhere(self, channel: _Channel, state: SessionState) -> bool:
        """Whether the axes rest where the reference is not."""
        if any(channel.sent.values()) or state.activity is not DeviceState.IDLE or state.queued:
            return False
        targets = channel.steering.now().joints
        return any(
            abs(state.command.get(axis, at) - at) > self._slack(axis)
            for axis, at in targets.items()
        )

    # --- modes and laws ---------------------------------------------------------------------------

    def _channels_for(self, intent: Intent, state: SessionState) -> tuple[_Channel, ...]:
        """Return what steers now, begun where the machine stands if it has not begun."""
        for name, channel in tuple(self._channels.items()):
            if not self._elsewhere(channel, state):
                continue
            del self._channels[name]
            # A stick that was in the middle a moment ago counts at once.
            if channel.refused or channel.steering.released:
                axes = channel.steering.frame.axes
                anew = self._channel(self._begun(name, axes, state), self._law, engaged=True)
                anew.steering.begin(anew.steering.frame.start, {}, intent.deflections)
                self._channels[name] = anew
        if self._mode not in self._channels:
            self._channels[self._mode] = self._channel(
                self._begun(self._mode, (), state), self._law
            )
        own = self._channels[self._mode].steering.frame.axes
        direct = tuple(
            axis
            for axis in self._robot.axes
            if axis in intent.deflections and axis not in (*DEGREES_OF_FREEDOM, *own)
        )
        if direct and DIRECT not in self._channels:
            self._channels[DIRECT] = self._channel(self._begun(DIRECT, direct, state), self._law)
        return tuple(
            self._channels[name] for name in (self._mode, DIRECT) if name in self._channels
        )

    def _begun(self, name: str, axes: tuple[str, ...], state: SessionState) -> Frame:
        """Return a frame begun where the machine stands; ``axes`` are those driven directly."""
        if name == DIRECT:
            return AxesFrame(self._robot, DIRECT, axes, state.command)
        return self.modes.begin(name, state.command)

    def _channel(self, frame: Frame, kind: LawKind, *, engaged: bool = False) -> _Channel:
        def law(coordinate: Coordinate) -> ScalingLaw:
            scale = self.scales.of(frame.name, coordinate)
            return scale.law(kind, coordinate, self._noise(coordinate))

        return _Channel(
            Steering(frame, kind, law, engaged=engaged), Following(self._robot, self._lag)
        )

    def _change_mode(self, name: str) -> None:
        """Begin another mode at the present reference; what it does not move, brakes."""
        old = self._channels.get(self._mode)
        if name == self._mode or old is None:
            self._mode = name
            return
        now = old.steering.now()
        joints = {**self._session.snapshot().command, **now.joints}
        channel = self._channel(self.modes.begin(name, joints), self._law)
        velocities = channel.steering.frame.velocities(now.speeds)
        self._mode = name
        del self._channels[old.steering.frame.name]
        self._drop_all()
        channel.steering.begin(channel.steering.frame.start, velocities, self._intent.deflections)
        self._channels[name] = channel
        self._halt(axis for axis in old.sent if axis not in channel.steering.frame.axes)
        channel.sent = {axis: old.sent.get(axis, 0.0) for axis in channel.steering.frame.axes}

    def _change_law(self, kind: LawKind) -> None:
        """Begin another law with the motion of the one before."""
        channels = {}
        for name, old in self._channels.items():
            channel = self._channel(old.steering.frame, kind, engaged=True)
            channel.steering.rescale(self._factor(self._intent))
            before = old.steering
            channel.steering.begin(before.coordinates, before.velocities, self._intent.deflections)
            channels[name] = replace(channel, following=old.following, sent=old.sent)
        self._law, self._channels = kind, channels

    def _release_axes(self, reason: str | None) -> None:
        """Halt the moving axes; steering restarts from where the machine is then."""
        if reason is not None:
            self._refused = reason
        self._drop_all()

    def _drop_all(self) -> None:
        for channel in tuple(self._channels.values()):
            self._halt(axis for axis, speed in channel.sent.items() if speed)
        self._channels.clear()

    def _halt(self, axes: Iterable[str]) -> None:
        still = dict.fromkeys(axes, 0.0)
        if still:
            # Refused, it is because nothing moves by this any more; the leases run out in any case.
            with suppress(InputError):
                self._session.move_velocity(still, LEASE_S, JOYSTICK)

    # --- details ----------------------------------------------------------------------------------

    def _request(self, change: Callable[[], None]) -> None:
        with self._lock:
            self._requests.append(change)

    def _frame(self) -> Frame | None:
        channel = self._channels.get(self._mode)
        return None if channel is None else channel.steering.frame

    def _factor(self, intent: Intent) -> float:
        factor = self._preset
        if Action.FINE in intent.held:
            factor *= FINE
        if Action.COARSE in intent.held:
            factor *= COARSE
        return factor

    def _felt(self, frame: Frame, state: SessionState) -> dict[str, float]:
        """Return what a contact is told by: how far the machine is from its model, a coordinate."""
        if self._law is not LawKind.IMPEDANCE:
            return {}
        deviations = {
            axis: state.measured[axis] - state.nominal[axis]  # whatever model is in use
            for axis in frame.axes
            if axis in state.measured and isfinite(state.nominal.get(axis, nan))
        }
        self._reactions = frame.velocities(deviations)
        return self._reactions

    def _noise(self, coordinate: Coordinate) -> float:
        """Return what a coordinate's deviation strays by without a contact, m or rad."""
        floors = [
            axis.sensor.noise_floor
            for axis in self._robot.axes.values()
            if axis.sensor is not None and axis.unit == coordinate.unit
        ]
        return _NOISE_FLOORS * max(floors, default=0.0)

    def _slack(self, axis: str) -> float:
        return 2.0 * max(resolution_of(self._robot.axes[axis]), 1e-6 * self._robot.axes[axis].span)


def _share(asked: Mapping[str, float], used: Mapping[str, float]) -> float:
    """Return the share of the speeds asked for that is used."""
    shares = [used.get(axis, speed) / speed for axis, speed in asked.items() if speed]
    return min(shares, default=1.0)
