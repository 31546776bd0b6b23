"""The sequence of a penetration: the actions of each phase, and the transitions between them.

After a stop, a fault or a lost link the tip is *held*: it stays where it is, and nothing here moves
it again.
"""

import threading
from collections import deque
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from datetime import datetime

import numpy as np

from rotemina.app.errors import PenetrationError
from rotemina.app.motion.penetration.arming import APPROACH_LEASE_S
from rotemina.app.motion.penetration.attempt import PenetrationAttempt
from rotemina.app.motion.penetration.detector import (
    ContactDetector,
    DetectedContact,
    measure_noise_at_rest,
)
from rotemina.app.motion.penetration.run_log import PenetrationRun, PenetrationVerdict
from rotemina.app.motion.penetration.sample_feed import AxisSampleQueue, AxisSamples, join_samples
from rotemina.app.motion.penetration.status import PenetrationPhase, PenetrationStatus
from rotemina.app.motion.penetration.thrust import evaluate_thrust, make_thrust_trace
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import (
    CommandRefused,
    SessionEvent,
    SessionState,
)
from rotemina.drivers.abilities import FastCapturer
from rotemina.drivers.contract import DeviceState
from rotemina.sim.errors import InputError
from rotemina.sim.messages import format_rounded, message
from rotemina.sim.units import format_exact

PENETRATION_OWNER = "penetration"
# Period at which the lease of the approach is renewed.
_LEASE_RENEWAL_S = 0.04
# Samples at rest over at least this time are needed to measure the noise.
_MIN_REST_S = 0.3
# Older samples at rest are dropped. The approach fails if there are too few after this time.
_REST_WINDOW_S = 10.0
# A capture lasts for this long before and after the thrust.
_CAPTURE_MARGIN_S = 0.1
# The device must carry out a command within this time.
_DEVICE_TIMEOUT_S = 2.0
_MAX_CAPTURE_HZ = 2000.0
_POSITION_TOLERANCE_M = 1e-9


class PenetrationSequence:
    """Phases of a run, from the approach to the end of the retraction.

    Each phase is stepped until it enters the next one. The subclass
    :class:`rotemina.app.motion.penetration.PenetrationController` takes the requests
    of the operator and holds the lock.

    Parameters
    ----------
    session : MotionSession
    wall_clock : callable
        Returns date and time, for the log.
    """

    def __init__(self, session: MotionSession, wall_clock: Callable[[], datetime]) -> None:
        self._session = session
        self._wall_clock = wall_clock
        self._lock = threading.RLock()
        #: The current status. It is replaced as a whole, so it can be read without the lock.
        self.status = PenetrationStatus()
        self._attempt: PenetrationAttempt | None = None
        self._sample_queue: AxisSampleQueue | None = None
        self._refusals: deque[str] = deque(maxlen=8)
        self._unlogged_runs: deque[PenetrationRun] = deque()
        self._unsubscribe = session.subscribe(self._on_event)
        # Permit of the run, or of the press of the button that retracts a held tip.
        self._permit = session.permit()
        self._phase_began_s = self._lease_renewed_s = self._armed_until_s = 0.0
        # Host time at which the axis came to rest on the membrane.
        self._rest_began_s: float | None = None
        # Whether the current phase has sent its command, and whether it has started the capture.
        self._has_sent_command = self._has_started_capture = False
        self._outcome = (PenetrationVerdict.DONE, "")
        self._phase_steps = {
            PenetrationPhase.APPROACH: self._step_approach,
            PenetrationPhase.CONTACT: self._step_contact,
            PenetrationPhase.THRUST: self._step_thrust,
            PenetrationPhase.HOLD: self._step_hold,
            PenetrationPhase.INJECT: self._step_inject,
            PenetrationPhase.HOLD_AFTER: self._step_hold_after,
            PenetrationPhase.RETRACT: self._step_retract,
        }

    def _advance(self, phase: PenetrationPhase, attempt: PenetrationAttempt, now_s: float) -> None:
        state = self._session.snapshot()
        samples = self._sample_queue.take() if self._sample_queue is not None else join_samples([])
        if len(samples):
            attempt.residual = float(samples.residual[-1])
            attempt.offset = float(samples.measured[-1] - samples.command[-1])
        interruption = self._find_interruption(state)
        if phase is PenetrationPhase.ARMED:
            self._step_armed(attempt, samples, interruption, now_s)
            return
        if interruption is not None:
            self._halt()
            self._hold_position(interruption, now_s)
            return
        try:
            self._phase_steps[phase](attempt, state, samples, now_s)
        except InputError as error:
            self._fail_run(str(error), now_s)
        self._update_status(attempt, state)

    def _step_armed(
        self,
        attempt: PenetrationAttempt,
        samples: AxisSamples,
        interruption: str | None,
        now_s: float,
    ) -> None:
        self._collect_rest_samples(attempt, samples)
        if interruption is None and now_s < self._armed_until_s:
            self.status = replace(self.status, armed_remaining_s=self._armed_until_s - now_s)
            return
        self._release_axes()
        self._enter_phase(
            PenetrationPhase.DISARMED,
            now_s,
            interruption or message("engine", "it was not started in time"),
        )

    def _step_approach(
        self, attempt: PenetrationAttempt, state: SessionState, samples: AxisSamples, now_s: float
    ) -> None:
        parameters = attempt.parameters
        velocity = parameters.sign * parameters.approach_speed
        if not attempt.detectors:
            self._collect_rest_samples(attempt, samples)
            if not self._measure_noise(attempt):
                self._fail_after(
                    now_s, _REST_WINDOW_S, message("engine", "the device sends too few samples")
                )
                return
        elif len(samples):
            contact = self._find_contact(attempt, samples)
            if contact is not None:
                self._session.note_contact("a penetration's tip was in contact")
                attempt.contact = contact
                attempt.contact_height = state.tip[2] if state.tip is not None else None
                self._halt()
                self._enter_phase(PenetrationPhase.CONTACT, now_s)
                return
        self._check_load(attempt)
        travel = parameters.sign * (state.command[parameters.axis] - attempt.start)
        if travel >= parameters.approach_distance:
            distance = format_exact(parameters.approach_distance, "m")
            self._fail_run(
                message("engine", "no contact within {distance}; start nearer to the cell").fill(
                    distance=distance
                ),
                now_s,
            )
        elif now_s - self._lease_renewed_s >= _LEASE_RENEWAL_S:
            self._lease_renewed_s = now_s
            self._session.move_velocity(
                {parameters.axis: velocity},
                APPROACH_LEASE_S,
                PENETRATION_OWNER,
                permit=self._permit,
            )
        self._fail_after(
            now_s,
            _REST_WINDOW_S + 3.0 * parameters.approach_distance / parameters.approach_speed,
            "no contact",
        )

    def _step_contact(
        self, attempt: PenetrationAttempt, state: SessionState, samples: AxisSamples, now_s: float
    ) -> None:
        """Rest on the membrane, upload the thrust, start the capture, then trigger the thrust."""
        self._check_load(attempt)
        attempt.thrust_samples.append(samples)
        pause_s = attempt.parameters.contact_pause_s
        self._fail_after(
            now_s,
            2.0 * (pause_s + _DEVICE_TIMEOUT_S),
            message("engine", "the axis did not come to rest"),
        )
        if not self._is_at_rest(state):
            self._rest_began_s = None
            return
        self._rest_began_s = now_s if self._rest_began_s is None else self._rest_began_s
        if (
            self.status.phase is not PenetrationPhase.CONTACT
            or now_s - self._rest_began_s < pause_s
        ):
            return
        if not self._has_sent_command:
            self._has_sent_command = True
            self._session.profiles.upload(
                attempt.plan.profile, PENETRATION_OWNER, permit=self._permit
            )
            return
        if not self._has_started_capture:
            self._has_started_capture = True
            self._start_capture(attempt)
            return
        samples_at_rest = join_samples(attempt.thrust_samples)
        attempt.contact_offset = float(
            np.mean((samples_at_rest.measured - samples_at_rest.command)[-20:])
        )
        attempt.thrust_start = state.command[attempt.parameters.axis]
        attempt.triggered_s = state.device_time_s
        self._session.profiles.trigger(PENETRATION_OWNER, permit=self._permit)
        self._enter_phase(PenetrationPhase.THRUST, now_s)

    def _step_thrust(
        self, attempt: PenetrationAttempt, state: SessionState, samples: AxisSamples, now_s: float
    ) -> None:
        parameters, plan = attempt.parameters, attempt.plan
        attempt.thrust_samples.append(samples)
        self._check_load(attempt)
        end_position = attempt.thrust_start + sum(
            segment.displacement for segment in plan.profile.segments
        )
        has_arrived = abs(state.command[parameters.axis] - end_position) <= 0.01 * parameters.depth
        capture_s = parameters.duration_s + 2.0 * _CAPTURE_MARGIN_S
        if not (
            self._is_at_rest(state) and has_arrived and now_s - self._phase_began_s > capture_s
        ):
            self._fail_after(
                now_s,
                capture_s + _DEVICE_TIMEOUT_S,
                message("engine", "the device did not run the thrust"),
            )
            return
        if not self._evaluate_thrust(attempt):
            self._fail_after(
                now_s,
                capture_s + _DEVICE_TIMEOUT_S,
                message("engine", "too few samples of the thrust"),
            )
            return
        assert attempt.thrust is not None, "the thrust was evaluated"
        if (
            abs(attempt.thrust.depth - parameters.depth)
            > parameters.depth_tolerance * parameters.depth
        ):
            self._fail_run(
                message(
                    "engine",
                    "the thrust reached {depth} instead of {asked}, more than {tolerance} % off",
                ).fill(
                    depth=format_exact(attempt.thrust.depth, "m"),
                    asked=format_exact(parameters.depth, "m"),
                    tolerance=format_rounded(100.0 * parameters.depth_tolerance, 6),
                ),
                now_s,
            )
            return
        self._enter_phase(PenetrationPhase.HOLD, now_s)

    def _step_hold(
        self, attempt: PenetrationAttempt, state: SessionState, samples: AxisSamples, now_s: float
    ) -> None:
        if now_s - self._phase_began_s < attempt.parameters.hold_s:
            return
        if attempt.parameters.inject_s > 0.0:
            self._session.tool.switch(True, permit=self._permit)
            self._enter_phase(PenetrationPhase.INJECT, now_s)
        else:
            self._enter_phase(PenetrationPhase.HOLD_AFTER, now_s)

    def _step_inject(
        self, attempt: PenetrationAttempt, state: SessionState, samples: AxisSamples, now_s: float
    ) -> None:
        if now_s - self._phase_began_s >= attempt.parameters.inject_s:
            self._session.tool.switch(False)
            self._enter_phase(PenetrationPhase.HOLD_AFTER, now_s)

    def _step_hold_after(
        self, attempt: PenetrationAttempt, state: SessionState, samples: AxisSamples, now_s: float
    ) -> None:
        if now_s - self._phase_began_s >= attempt.parameters.hold_after_s:
            self._begin_retraction(PenetrationVerdict.DONE, "", now_s)

    def _step_retract(
        self, attempt: PenetrationAttempt, state: SessionState, samples: AxisSamples, now_s: float
    ) -> None:
        parameters = attempt.parameters
        distance = abs(state.command[parameters.axis] - attempt.start)
        if not self._has_sent_command:
            if self._is_at_rest(state):
                self._has_sent_command = True
                speeds = {parameters.axis: parameters.retract_speed}
                self._session.go_to(
                    {parameters.axis: attempt.start}, PENETRATION_OWNER, speeds, permit=self._permit
                )
            self._fail_after(
                now_s, _DEVICE_TIMEOUT_S, message("engine", "the axis did not come to rest")
            )
        elif self._is_at_rest(state) and distance <= _POSITION_TOLERANCE_M:
            self._finish_run(now_s)
        else:
            limit_s = (
                parameters.approach_distance + parameters.depth
            ) / parameters.retract_speed + 2.0 * _DEVICE_TIMEOUT_S
            self._fail_after(now_s, limit_s, message("engine", "the axis did not return"))

    def _collect_rest_samples(self, attempt: PenetrationAttempt, samples: AxisSamples) -> None:
        rest_samples = join_samples([attempt.rest_samples, samples])
        if len(rest_samples):
            recent_samples = rest_samples.select_later(
                float(rest_samples.time_s[-1]) - _REST_WINDOW_S
            )
            attempt.rest_samples = (
                recent_samples
                if len(recent_samples) <= 1000
                else recent_samples.select_later(recent_samples.time_s[-1000])
            )

    def _find_contact(
        self, attempt: PenetrationAttempt, samples: AxisSamples
    ) -> DetectedContact | None:
        """Return the earliest contact that a detector reports, or None.

        The detector for the nominal model always runs, so that a wrong model in use cannot hide a
        contact.
        """
        residuals = (samples.nominal, samples.residual)
        contacts = [
            detector.feed(samples.time_s, samples.command, samples.measured, residual)
            for detector, residual in zip(attempt.detectors, residuals, strict=False)
        ]
        return min(filter(None, contacts), key=lambda contact: contact.detected_s, default=None)

    def _measure_noise(self, attempt: PenetrationAttempt) -> bool:
        """Measure the noise and make the detectors; return False if there are too few samples."""
        rest_samples, parameters = attempt.rest_samples, attempt.parameters
        if not len(rest_samples) or rest_samples.time_s[-1] - rest_samples.time_s[0] < _MIN_REST_S:
            return False
        sensor = self._session.robot.axes[parameters.axis].sensor
        rounding_noise = sensor.resolution / np.sqrt(12.0) if sensor is not None else 0.0
        residuals = [rest_samples.nominal]
        if self._session.model.is_corrected:
            residuals.append(rest_samples.residual)
        try:
            noises = [
                measure_noise_at_rest(rest_samples.time_s, residual, float(rounding_noise))
                for residual in residuals
            ]
        except PenetrationError:
            return False
        attempt.noise = noises[-1]
        attempt.rest_offset = float(np.mean(rest_samples.measured - rest_samples.command))
        attempt.detectors = tuple(
            ContactDetector(
                noise,
                attempt.start,
                parameters.sign,
                drift=parameters.drift,
                drift_length=parameters.drift_length,
                false_alarms_per_hour=parameters.false_alarms_per_hour,
            )
            for noise in noises
        )
        return True

    def _check_load(self, attempt: PenetrationAttempt) -> None:
        load, limit = attempt.compute_load(), attempt.parameters.overload
        if load > limit:
            raise PenetrationError(
                "overload: the axis is {load} from its command; at most {most} is permitted",
                load=format_exact(load, "m"),
                most=format_exact(limit, "m"),
            )

    def _start_capture(self, attempt: PenetrationAttempt) -> None:
        driver, parameters = self._session.driver, attempt.parameters
        if isinstance(driver, FastCapturer):
            rate_hz = min(driver.capture_rates.max_rate_for(1), _MAX_CAPTURE_HZ)
            count = int((parameters.duration_s + 2.0 * _CAPTURE_MARGIN_S) * rate_hz)
            self._session.captures.begin(
                (parameters.axis,), rate_hz, min(count, driver.capture_rates.max_samples)
            )

    def _evaluate_thrust(self, attempt: PenetrationAttempt) -> bool:
        """Compare the thrust with its profile; return False while the capture is incomplete."""
        assert attempt.triggered_s is not None, "the thrust was triggered"
        slow_samples = join_samples(attempt.thrust_samples)
        captures = [capture for capture in self._session.captures.collect() if not capture.lost]
        attempt.captures += captures
        if isinstance(self._session.driver, FastCapturer) and not any(
            capture.complete for capture in attempt.captures
        ):
            return False
        captured_s = np.concatenate(
            [np.zeros(0), *(capture.device_time_s for capture in attempt.captures)]
        )
        # The capture begins before the thrust. From then on only its denser samples are used.
        is_before_capture = slow_samples.time_s < (captured_s[0] if len(captured_s) else np.inf)
        time_s = np.concatenate([slow_samples.time_s[is_before_capture], captured_s])
        measured = np.concatenate(
            [
                slow_samples.measured[is_before_capture],
                *(capture.measured[:, 0] for capture in attempt.captures),
            ]
        )
        begin_s = attempt.triggered_s
        attempt.thrust = evaluate_thrust(attempt.plan, time_s, measured, begin_s)
        trace = make_thrust_trace(attempt.plan, time_s, measured, begin_s, attempt.thrust.delay_s)
        self.status = replace(self.status, trace=trace)
        return True

    def _find_interruption(self, state: SessionState) -> str | None:
        if state.lock_reason is not None:
            return state.lock_reason
        if not self._permit.is_valid:
            return message("engine", "a stop was requested")
        if not self._session.reservations.is_reserved_by(PENETRATION_OWNER):
            return message("engine", "another control took over an axis")
        return None

    def _fail_after(self, now_s: float, limit_s: float, reason: str) -> None:
        """Fail if the phase has taken longer than its limit; the reason includes any refusals."""
        if now_s - self._phase_began_s > limit_s:
            refusals = "; ".join(self._refusals)
            self._fail_run(f"{reason}: {refusals}" if refusals else reason, now_s)

    def _fail_run(self, reason: str, now_s: float) -> None:
        """Fail the run and retract. If the retraction itself has failed, hold the tip instead."""
        if self.status.phase is PenetrationPhase.RETRACT:
            self._halt()
            self._hold_position(reason, now_s)
        else:
            self._begin_retraction(PenetrationVerdict.FAILED, reason, now_s)

    def _begin_retraction(self, verdict: PenetrationVerdict, reason: str, now_s: float) -> None:
        self._outcome = (verdict, reason)
        self._halt()
        self._enter_phase(PenetrationPhase.RETRACT, now_s, reason)

    def _halt(self) -> None:
        """Switch the tool off and halt the axis without a fault; ignore refusals."""
        phase, attempt = self.status.phase, self._attempt
        if self._session.tool.is_on is not None:
            with suppress(InputError):
                self._session.tool.switch(False)
        with suppress(InputError):
            if phase is PenetrationPhase.THRUST:
                self._session.profiles.abort()
            elif attempt is not None and phase in (
                PenetrationPhase.APPROACH,
                PenetrationPhase.RETRACT,
            ):
                self._session.move_velocity(
                    {attempt.parameters.axis: 0.0}, APPROACH_LEASE_S, PENETRATION_OWNER
                )

    def _hold_position(self, reason: str, now_s: float) -> None:
        """End the run with the tip where it is, and keep the axes reserved."""
        self._outcome = (PenetrationVerdict.HELD, reason)
        self._end_run(PenetrationPhase.HELD, now_s)

    def _finish_run(self, now_s: float) -> None:
        phases = {
            PenetrationVerdict.DONE: PenetrationPhase.DONE,
            PenetrationVerdict.ABORTED: PenetrationPhase.ABORTED,
        }
        self._end_run(phases.get(self._outcome[0], PenetrationPhase.FAILED), now_s)
        self._release_axes()

    def _end_run(self, phase: PenetrationPhase, now_s: float) -> None:
        """Enter the phase in which the run ends.

        The status is replaced once, with phase and run, because others read it without the lock.
        The next step logs the run outside the lock, because a disk may be slow.
        """
        (verdict, reason), attempt, session = self._outcome, self._attempt, self._session
        assert attempt is not None, "a run is ending"
        self._begin_phase(phase, now_s)
        model = session.model.id
        run = attempt.make_run(session.robot, session.driver.name, verdict, reason, model)
        labels = session.labels
        run = replace(run, run=labels.run, operator=labels.operator, sample=labels.sample)
        self._unlogged_runs.append(run)
        self.status = replace(
            self.status, phase=phase, reason=reason, armed_remaining_s=None, run=run, log_problem=""
        )

    def _release_axes(self) -> None:
        self._session.reservations.end_reservations(PENETRATION_OWNER)
        if self._sample_queue is not None:
            self._sample_queue.unsubscribe()
        self._sample_queue = self._attempt = None

    def _enter_phase(self, phase: PenetrationPhase, now_s: float, reason: str = "") -> None:
        self._begin_phase(phase, now_s)
        self.status = replace(self.status, phase=phase, reason=reason, armed_remaining_s=None)

    def _begin_phase(self, phase: PenetrationPhase, now_s: float) -> None:
        self._phase_began_s, self._rest_began_s = now_s, None
        self._has_sent_command = self._has_started_capture = False
        if self._attempt is not None and phase is not PenetrationPhase.DISARMED:
            self._attempt.note_phase(str(phase), now_s)

    def _update_status(self, attempt: PenetrationAttempt, state: SessionState) -> None:
        travel = abs(state.command[attempt.parameters.axis] - attempt.start)
        self.status = replace(
            self.status,
            travel=travel,
            deviation=attempt.compute_deviation(),
            load=attempt.compute_load(),
        )

    def _is_at_rest(self, state: SessionState) -> bool:
        return state.activity is DeviceState.IDLE and self._session.at_rest

    def _on_event(self, event: SessionEvent) -> None:
        if isinstance(event, CommandRefused):
            self._refusals.append(event.message)
