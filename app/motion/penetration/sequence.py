"""The sequence of a penetration: the actions of each phase, and the transitions between them.

A stop, a fault or a lost link *holds* the tip where it is: nothing here moves it again.
"""

import threading
from collections import deque
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from datetime import datetime

import numpy as np

from rotemina.app.motion.penetration.arming import LEASE_S
from rotemina.app.motion.penetration.attempt import Attempt
from rotemina.app.motion.penetration.detector import Contact, ContactDetector, noise_at_rest
from rotemina.app.motion.penetration.parameters import PenetrationError
from rotemina.app.motion.penetration.run_log import PenetrationRun, Verdict
from rotemina.app.motion.penetration.sample_feed import AxisFeed, AxisSamples, joined
from rotemina.app.motion.penetration.status import PenetrationStatus, Phase
from rotemina.app.motion.penetration.thrust import thrust_response, thrust_trace
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import CommandRefused, Event, SessionState
from rotemina.drivers.abilities import Capturer
from rotemina.drivers.samples import DeviceState
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message
from rotemina.sim.quantities import exact, rounded

OWNER = "penetration"
_RENEW_S = 0.04  # of the lease
_REST_S = 0.3  # of samples at rest, from which the noise is known
_LISTEN_S = 10.0  # how long it waits for them
_MARGIN_S = 0.1  # of samples before and after the thrust
_PATIENCE_S = 2.0  # with a device that was told something
_CAPTURE_HZ = 2000.0
_SAME = 1e-9  # m


class PenetrationSequence:
    """The phases of a run, from the approach to the end of the retraction.

    Each is stepped until it says which one comes next. What is asked of a run from outside, and
    the lock, are :class:`rotemina.app.motion.penetration.penetration.Penetration`'s.

    Parameters
    ----------
    session : MotionSession
    today : callable
        Return date and time, for the log.
    """

    def __init__(self, session: MotionSession, today: Callable[[], datetime]) -> None:
        self._session = session
        self._today = today
        self._lock = threading.RLock()
        #: The present state, available at once; replaced as a whole.
        self.status = PenetrationStatus()
        self._attempt: Attempt | None = None
        self._feed: AxisFeed | None = None
        self._refusals: deque[str] = deque(maxlen=8)
        self._unwritten: deque[PenetrationRun] = deque()
        self._end = session.subscribe(self._hear)
        self._permit = session.permit()  # of the run, or of the button that goes on with it
        self._since_s = self._renewed_s = self._armed_until_s = 0.0
        self._rested_s: float | None = None  # since when the axis rests, on the membrane
        # Whether the device was told what the phase is about, and to capture.
        self._told = self._capturing = False
        self._outcome = (Verdict.DONE, "")
        self._steps = {
            Phase.APPROACH: self._approach,
            Phase.CONTACT: self._touch,
            Phase.THRUST: self._thrust,
            Phase.HOLD: self._hold,
            Phase.INJECT: self._inject,
            Phase.HOLD_AFTER: self._hold_after,
            Phase.RETRACT: self._retract,
        }

    def _go_on(self, phase: Phase, attempt: Attempt, now_s: float) -> None:
        state = self._session.snapshot()
        samples = self._feed.taken() if self._feed is not None else joined([])
        if len(samples):
            attempt.residual = float(samples.residual[-1])
            attempt.offset = float(samples.measured[-1] - samples.command[-1])
        broken = self._broken(state)
        if phase is Phase.ARMED:
            self._wait(attempt, samples, broken, now_s)
            return
        if broken is not None:
            self._halt()
            self._hold_here(broken, now_s)
            return
        try:
            self._steps[phase](attempt, state, samples, now_s)
        except InputError as error:
            self._fail(str(error), now_s)
        self._show(attempt, state)

    def _wait(
        self, attempt: Attempt, samples: AxisSamples, broken: str | None, now_s: float
    ) -> None:
        """Measure the noise; disarm when time is up, or something has happened."""
        self._listen(attempt, samples)
        if broken is None and now_s < self._armed_until_s:
            self.status = replace(self.status, armed_left_s=self._armed_until_s - now_s)
            return
        self._release()
        self._enter(
            Phase.DISARMED, now_s, broken or message("engine", "it was not started in time")
        )

    # --- phases ---------------------------------------------------------------------------------

    def _approach(
        self, attempt: Attempt, state: SessionState, samples: AxisSamples, now_s: float
    ) -> None:
        p = attempt.parameters
        velocity = p.sign * p.approach_speed
        if not attempt.detectors:
            self._listen(attempt, samples)
            if not self._knows_noise(attempt):
                self._await(now_s, _LISTEN_S, message("engine", "the device sends too few samples"))
                return
        elif len(samples):
            contact = self._contact(attempt, samples)
            if contact is not None:
                self._session.note_contact("a penetration's tip was in contact")
                attempt.contact = contact
                attempt.contact_height = state.tip[2] if state.tip is not None else None
                self._halt()
                self._enter(Phase.CONTACT, now_s)
                return
        self._check_load(attempt)
        way = p.sign * (state.command[p.axis] - attempt.start)
        if way >= p.approach_distance:
            distance = exact(p.approach_distance, "m")
            self._fail(
                message("engine", "no contact within {distance}; start nearer to the cell").fill(
                    distance=distance
                ),
                now_s,
            )
        elif now_s - self._renewed_s >= _RENEW_S:
            self._renewed_s = now_s
            self._session.move_velocity({p.axis: velocity}, LEASE_S, OWNER, permit=self._permit)
        self._await(now_s, _LISTEN_S + 3.0 * p.approach_distance / p.approach_speed, "no contact")

    def _touch(
        self, attempt: Attempt, state: SessionState, samples: AxisSamples, now_s: float
    ) -> None:
        """Rest on the membrane, then upload the thrust, then trigger it."""
        self._check_load(attempt)
        attempt.thrusting.append(samples)
        pause_s = attempt.parameters.contact_pause_s
        self._await(
            now_s, 2.0 * (pause_s + _PATIENCE_S), message("engine", "the axis did not come to rest")
        )
        if not self._at_rest(state):
            self._rested_s = None
            return
        self._rested_s = now_s if self._rested_s is None else self._rested_s
        if self.status.phase is not Phase.CONTACT or now_s - self._rested_s < pause_s:
            return
        if not self._told:
            self._told = True
            self._session.profiles.upload(attempt.plan.profile, OWNER, permit=self._permit)
            return
        if not self._capturing:
            self._capturing = True
            self._capture(attempt)
            return
        recent = joined(attempt.thrusting)
        attempt.contact_offset = float(np.mean((recent.measured - recent.command)[-20:]))
        attempt.thrust_from = state.command[attempt.parameters.axis]
        attempt.triggered_s = state.device_time_s
        self._session.profiles.trigger(OWNER, permit=self._permit)
        self._enter(Phase.THRUST, now_s)

    def _thrust(
        self, attempt: Attempt, state: SessionState, samples: AxisSamples, now_s: float
    ) -> None:
        p, plan = attempt.parameters, attempt.plan
        attempt.thrusting.append(samples)
        self._check_load(attempt)
        end = attempt.thrust_from + sum(one.length for one in plan.profile.segments)
        there = abs(state.command[p.axis] - end) <= 0.01 * p.depth
        over_s = p.duration_s + 2.0 * _MARGIN_S
        if not (self._at_rest(state) and there and now_s - self._since_s > over_s):
            self._await(
                now_s, over_s + _PATIENCE_S, message("engine", "the device did not run the thrust")
            )
            return
        if not self._evaluated(attempt):
            self._await(
                now_s, over_s + _PATIENCE_S, message("engine", "too few samples of the thrust")
            )
            return
        assert attempt.thrust is not None, "evaluated"
        if abs(attempt.thrust.depth - p.depth) > p.depth_tolerance * p.depth:
            self._fail(
                message(
                    "engine",
                    "the thrust reached {depth} instead of {asked}, more than {tolerance} % off",
                ).fill(
                    depth=exact(attempt.thrust.depth, "m"),
                    asked=exact(p.depth, "m"),
                    tolerance=rounded(100.0 * p.depth_tolerance, 6),
                ),
                now_s,
            )
            return
        self._enter(Phase.HOLD, now_s)

    def _hold(
        self, attempt: Attempt, state: SessionState, samples: AxisSamples, now_s: float
    ) -> None:
        if now_s - self._since_s < attempt.parameters.hold_s:
            return
        if attempt.parameters.inject_s > 0.0:
            self._session.tool.switch(True, permit=self._permit)
            self._enter(Phase.INJECT, now_s)
        else:
            self._enter(Phase.HOLD_AFTER, now_s)

    def _inject(
        self, attempt: Attempt, state: SessionState, samples: AxisSamples, now_s: float
    ) -> None:
        if now_s - self._since_s >= attempt.parameters.inject_s:
            self._session.tool.switch(False)
            self._enter(Phase.HOLD_AFTER, now_s)

    def _hold_after(
        self, attempt: Attempt, state: SessionState, samples: AxisSamples, now_s: float
    ) -> None:
        if now_s - self._since_s >= attempt.parameters.hold_after_s:
            self._back(Verdict.DONE, "", now_s)

    def _retract(
        self, attempt: Attempt, state: SessionState, samples: AxisSamples, now_s: float
    ) -> None:
        """Go back along the path as soon as the axis rests."""
        p = attempt.parameters
        way = abs(state.command[p.axis] - attempt.start)
        if not self._told:
            if self._at_rest(state):
                self._told = True
                speeds = {p.axis: p.retract_speed}
                self._session.go_to({p.axis: attempt.start}, OWNER, speeds, permit=self._permit)
            self._await(now_s, _PATIENCE_S, message("engine", "the axis did not come to rest"))
        elif self._at_rest(state) and way <= _SAME:
            self._finish(now_s)
        else:
            most_s = (p.approach_distance + p.depth) / p.retract_speed + 2.0 * _PATIENCE_S
            self._await(now_s, most_s, message("engine", "the axis did not return"))

    # --- what phases share ----------------------------------------------------------------------

    def _listen(self, attempt: Attempt, samples: AxisSamples) -> None:
        kept = joined([attempt.resting, samples])
        if len(kept):
            latest = kept.since(float(kept.time_s[-1]) - _LISTEN_S)
            attempt.resting = latest if len(latest) <= 1000 else latest.since(latest.time_s[-1000])

    def _contact(self, attempt: Attempt, samples: AxisSamples) -> Contact | None:
        """Return what any of the detectors is sure of: no model makes them less watchful."""
        residuals = (samples.nominal, samples.residual)
        found = [
            detector.feed(samples.time_s, samples.command, samples.measured, residual)
            for detector, residual in zip(attempt.detectors, residuals, strict=False)
        ]
        return min(filter(None, found), key=lambda one: one.detected_s, default=None)

    def _knows_noise(self, attempt: Attempt) -> bool:
        resting, p = attempt.resting, attempt.parameters
        if not len(resting) or resting.time_s[-1] - resting.time_s[0] < _REST_S:
            return False
        sensor = self._session.robot.axes[p.axis].sensor
        floor = sensor.resolution / np.sqrt(12.0) if sensor is not None else 0.0
        residuals = [resting.nominal]
        if self._session.model.corrected:
            residuals.append(resting.residual)
        try:
            noises = [noise_at_rest(resting.time_s, one, float(floor)) for one in residuals]
        except PenetrationError:
            return False
        attempt.noise = noises[-1]
        attempt.rest_offset = float(np.mean(resting.measured - resting.command))
        attempt.detectors = tuple(
            ContactDetector(
                noise,
                attempt.start,
                p.sign,
                drift=p.drift,
                drift_length=p.drift_length,
                false_alarms_per_hour=p.false_alarms_per_hour,
            )
            for noise in noises
        )
        return True

    def _check_load(self, attempt: Attempt) -> None:
        load, most = attempt.load(), attempt.parameters.overload
        if load > most:
            raise PenetrationError(
                message(
                    "engine",
                    "overload: the axis is {load} from its command; at most {most} is permitted",
                ).fill(load=exact(load, "m"), most=exact(most, "m"))
            )

    def _capture(self, attempt: Attempt) -> None:
        driver, p = self._session.driver, attempt.parameters
        if isinstance(driver, Capturer):
            rate_hz = min(driver.capture_rates.of(1), _CAPTURE_HZ)
            count = int((p.duration_s + 2.0 * _MARGIN_S) * rate_hz)
            self._session.captures.begin(
                (p.axis,), rate_hz, min(count, driver.capture_rates.samples)
            )

    def _evaluated(self, attempt: Attempt) -> bool:
        """Compare the thrust with its profile, from the samples that are densest."""
        assert attempt.triggered_s is not None, "the thrust was triggered"
        slow = joined(attempt.thrusting)
        fast = [part for part in self._session.captures.collected() if not part.lost]
        attempt.captured += fast
        if isinstance(self._session.driver, Capturer) and not any(
            part.complete for part in attempt.captured
        ):
            return False
        fast_s = np.concatenate([np.zeros(0), *(c.device_time_s for c in attempt.captured)])
        # A capture begins before the thrust: from there on its samples are all that count.
        before = slow.time_s < (fast_s[0] if len(fast_s) else np.inf)
        time_s = np.concatenate([slow.time_s[before], fast_s])
        measured = np.concatenate(
            [slow.measured[before], *(c.measured[:, 0] for c in attempt.captured)]
        )
        begin_s = attempt.triggered_s
        attempt.thrust = thrust_response(attempt.plan, time_s, measured, begin_s)
        trace = thrust_trace(attempt.plan, time_s, measured, begin_s, attempt.thrust.delay_s)
        self.status = replace(self.status, trace=trace)
        return True

    def _broken(self, state: SessionState) -> str | None:
        """Return why the sequence must not continue, or None."""
        if state.locked is not None:
            return state.locked
        if not self._permit.valid:
            return message("engine", "a stop was requested")
        if not self._session.reservations.held_by(OWNER):
            return message("engine", "another control took over an axis")
        return None

    def _await(self, now_s: float, most_s: float, what: str) -> None:
        """Fail when a phase takes too long; with the device's own word, if it said one."""
        if now_s - self._since_s > most_s:
            said = "; ".join(self._refusals)
            self._fail(f"{what}: {said}" if said else what, now_s)

    def _fail(self, reason: str, now_s: float) -> None:
        """Go back because of this; where going back is what failed, hold."""
        if self.status.phase is Phase.RETRACT:
            self._halt()
            self._hold_here(reason, now_s)
        else:
            self._back(Verdict.FAILED, reason, now_s)

    def _back(self, verdict: Verdict, reason: str, now_s: float) -> None:
        self._outcome = (verdict, reason)
        self._halt()
        self._enter(Phase.RETRACT, now_s, reason)

    def _halt(self) -> None:
        """Let the axis come to a halt without a fault, and the tool be off; as far as possible."""
        phase, attempt = self.status.phase, self._attempt
        if self._session.tool.on is not None:
            with suppress(InputError):
                self._session.tool.switch(False)
        with suppress(InputError):
            if phase is Phase.THRUST:
                self._session.profiles.abort()
            elif attempt is not None and phase in (Phase.APPROACH, Phase.RETRACT):
                self._session.move_velocity({attempt.parameters.axis: 0.0}, LEASE_S, OWNER)

    def _hold_here(self, reason: str, now_s: float) -> None:
        """Stay where the tip is, and keep the axes reserved."""
        self._outcome = (Verdict.HELD, reason)
        self._conclude(Phase.HELD, now_s)

    def _finish(self, now_s: float) -> None:
        ends = {Verdict.DONE: Phase.DONE, Verdict.ABORTED: Phase.ABORTED}
        self._conclude(ends.get(self._outcome[0], Phase.FAILED), now_s)
        self._release()

    def _conclude(self, phase: Phase, now_s: float) -> None:
        """Enter the phase in which the run ends.

        The status takes phase and run at once: others look at it without the lock. The run is
        logged by the next step, outside of the lock: a disk may be slow.
        """
        (verdict, reason), attempt, session = self._outcome, self._attempt, self._session
        assert attempt is not None, "under way"
        self._begin(phase, now_s)
        model = session.model.id
        run = attempt.ended(session.robot, session.driver.name, verdict, reason, model)
        said = session.labels
        run = replace(run, run=said.run, operator=said.operator, sample=said.sample)
        self._unwritten.append(run)
        self.status = replace(
            self.status, phase=phase, reason=reason, armed_left_s=None, run=run, problem=""
        )

    def _release(self) -> None:
        self._session.reservations.set_free(OWNER)
        if self._feed is not None:
            self._feed.end()
        self._feed = self._attempt = None

    def _enter(self, phase: Phase, now_s: float, reason: str = "") -> None:
        self._begin(phase, now_s)
        self.status = replace(self.status, phase=phase, reason=reason, armed_left_s=None)

    def _begin(self, phase: Phase, now_s: float) -> None:
        self._since_s, self._rested_s = now_s, None
        self._told = self._capturing = False
        if self._attempt is not None and phase is not Phase.DISARMED:
            self._attempt.noted(str(phase), now_s)

    def _show(self, attempt: Attempt, state: SessionState) -> None:
        way = abs(state.command[attempt.parameters.axis] - attempt.start)
        self.status = replace(
            self.status, way=way, deviation=attempt.deviation(), load=attempt.load()
        )

    def _at_rest(self, state: SessionState) -> bool:
        """Whether the machine rested, and nothing has been handed to it since."""
        return state.activity is DeviceState.IDLE and self._session.at_rest

    def _hear(self, event: Event) -> None:
        if isinstance(event, CommandRefused):
            self._refusals.append(event.message)
