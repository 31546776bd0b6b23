"""Automatic cell penetration: arm, approach, detect the membrane, thrust, and retract.

After a stop, a fault or a lost link the tip is *held*: it stays where it is. Nothing here moves it
again until the operator presses the button or takes over the axes.
"""

from collections.abc import Callable
from dataclasses import replace
from datetime import UTC, datetime

from rotemina.app.errors import RequestRefusedError
from rotemina.app.motion.penetration.arming import check_can_arm, prepare_attempt
from rotemina.app.motion.penetration.attempt import PenetrationAttempt
from rotemina.app.motion.penetration.parameters import PenetrationParameters
from rotemina.app.motion.penetration.run_log import PenetrationVerdict, RunLog
from rotemina.app.motion.penetration.sample_feed import AxisSampleQueue
from rotemina.app.motion.penetration.sequence import PENETRATION_OWNER, PenetrationSequence
from rotemina.app.motion.penetration.status import (
    RUNNING_PHASES,
    PenetrationPhase,
    PenetrationStatus,
)
from rotemina.app.motion.penetration.thrust import ThrustPlan
from rotemina.app.motion.session import MotionSession
from rotemina.sim.errors import InputError
from rotemina.sim.messages import marked, message


class PenetrationController(PenetrationSequence):
    """State machine of a penetration. It runs no thread: its owner calls :meth:`step` at 200 Hz.

    Every method may be called from any thread.

    Parameters
    ----------
    session : MotionSession
    log : RunLog, optional
        Log to which finished runs are appended.
    wall_clock : callable
        Returns date and time, for the log.
    """

    def __init__(
        self,
        session: MotionSession,
        log: RunLog | None = None,
        *,
        wall_clock: Callable[[], datetime] = lambda: datetime.now(UTC),
    ) -> None:
        super().__init__(session, wall_clock)
        self._log = log

    def arm(self, parameters: PenetrationParameters, now_s: float) -> None:
        """Check all conditions and reserve every axis; nothing moves until the button is pressed.

        Raises
        ------
        InputError
            If a run is running or held, the device or robot is unsuitable, the range or the tip's
            bounds leave too little room, or an axis has another owner.
        """
        with self._lock:
            if (busy_reason := self._find_busy_reason()) is not None:
                raise RequestRefusedError(busy_reason)
            self._release_axes()
            permit = self._session.permit()
            self._attempt = prepare_attempt(self._session, parameters, PENETRATION_OWNER)
            self._sample_queue = AxisSampleQueue(self._session, parameters.axis)
            self._permit = permit
            self._armed_until_s = now_s + parameters.armed_s
            self.status = PenetrationStatus(
                PenetrationPhase.ARMED,
                armed_remaining_s=parameters.armed_s,
                run=self.status.run,
                trace=self.status.trace,
            )

    def find_refusal_reason(
        self, parameters: PenetrationParameters, plan: ThrustPlan
    ) -> str | None:
        """Return why :meth:`arm` would now refuse parameters and their plan, or None.

        This reserves nothing and never waits.
        """
        if (busy_reason := self._find_busy_reason()) is not None:
            return busy_reason
        try:
            check_can_arm(self._session, parameters, plan, PENETRATION_OWNER)
        except InputError as error:
            return str(error)
        return None

    def _find_busy_reason(self) -> str | None:
        phase = self.status.phase
        if phase not in RUNNING_PHASES | {PenetrationPhase.HELD}:
            return None
        return message("engine", "a penetration is in phase {phase}; end it first").fill(
            phase=phase
        )

    def disarm(self) -> None:
        """End the reservation of the axes. A held tip stays where it is.

        Raises
        ------
        RequestRefusedError
            If a run is running. The button must be pressed first.
        """
        with self._lock:
            if self.status.phase in RUNNING_PHASES:
                raise RequestRefusedError(
                    "a penetration is in phase {phase}; stop it first", phase=self.status.phase
                )
            self._release_axes()
            self._enter_phase(PenetrationPhase.DISARMED, 0.0)

    def close(self) -> None:
        """Disconnect from the session. The tip of a running penetration is held where it is."""
        with self._lock:
            if self.status.phase in RUNNING_PHASES:
                self._halt()
                self._hold_position(
                    marked("engine", "the program released it"), self._phase_began_s
                )
            self._release_axes()
            self._unsubscribe()
        self._log_runs()

    def press_button(self, now_s: float) -> None:
        """Press the button.

        An armed run starts, and a running or held one retracts. During the retraction the button
        holds the tip.

        Raises
        ------
        InputError
            If the penetration is not armed, running or held, or the held tip cannot be moved now.
        """
        with self._lock:
            phase, attempt = self.status.phase, self._attempt
            if attempt is None or phase not in RUNNING_PHASES | {
                PenetrationPhase.ARMED,
                PenetrationPhase.HELD,
            }:
                raise RequestRefusedError("the penetration is not armed; arm it first")
            if phase is PenetrationPhase.ARMED:
                self._start_run(attempt, now_s)
            elif phase is PenetrationPhase.HELD:
                self._retract_held(now_s)
            elif phase is PenetrationPhase.RETRACT:
                self._halt()
                self._hold_position(
                    message("engine", "the retraction was stopped by the button"), now_s
                )
            else:
                self._begin_retraction(
                    PenetrationVerdict.ABORTED,
                    message("engine", "stopped by the button in {phase}").fill(phase=phase),
                    now_s,
                )

    def step(self, now_s: float) -> None:
        """Advance the run to the host time ``now_s``. Errors of the device are not raised."""
        with self._lock:
            phase, attempt = self.status.phase, self._attempt
            if attempt is not None and phase in self._phase_steps.keys() | {PenetrationPhase.ARMED}:
                self._advance(phase, attempt, now_s)
        self._log_runs()

    def _start_run(self, attempt: PenetrationAttempt, now_s: float) -> None:
        state = self._session.snapshot()
        interruption = self._find_interruption(state)
        if interruption is not None:
            raise RequestRefusedError("the penetration cannot start: {broken}", broken=interruption)
        if state.command[attempt.parameters.axis] != attempt.start:
            raise RequestRefusedError("the axis has moved since it was armed; arm it again")
        attempt.began_s, attempt.started = now_s, self._wall_clock().isoformat()
        self._refusals.clear()
        self._lease_renewed_s = float("-inf")
        self._enter_phase(PenetrationPhase.APPROACH, now_s)

    def _retract_held(self, now_s: float) -> None:
        permit = self._session.permit()
        state = self._session.snapshot()
        if state.lock_reason is not None:
            raise RequestRefusedError("the tip cannot be moved: {locked}", locked=state.lock_reason)
        if not self._session.reservations.is_reserved_by(PENETRATION_OWNER):
            raise RequestRefusedError("the penetration no longer owns the axes; move them manually")
        self._permit = permit
        self._outcome = (
            PenetrationVerdict.ABORTED,
            message("engine", "retracted by the button; before: {reason}").fill(
                reason=self.status.reason
            ),
        )
        self._refusals.clear()
        self._enter_phase(PenetrationPhase.RETRACT, now_s)

    def _log_runs(self) -> None:
        """Log the runs that have ended. A full disk is only reported."""
        while self._unlogged_runs:
            run = self._unlogged_runs.popleft()
            try:
                if self._log is not None:
                    self._log.append(run)
            except InputError as error:
                with self._lock:
                    self.status = replace(self.status, log_problem=str(error))
