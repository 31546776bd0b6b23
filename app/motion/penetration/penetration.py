"""Automatic cell penetration: arm, approach, detect the membrane, thrust, and retract.

A stop, a fault or a lost link *holds* the tip where it is: nothing here moves it again until
someone presses the button again or takes the axes over.
"""

from collections.abc import Callable
from dataclasses import replace
from datetime import UTC, datetime

from rotemina.app.motion.mailbox import RefusedError
from rotemina.app.motion.penetration.arming import armed, check_now
from rotemina.app.motion.penetration.attempt import Attempt
from rotemina.app.motion.penetration.parameters import PenetrationParameters
from rotemina.app.motion.penetration.run_log import RunLog, Verdict
from rotemina.app.motion.penetration.sample_feed import AxisFeed
from rotemina.app.motion.penetration.sequence import OWNER, PenetrationSequence
from rotemina.app.motion.penetration.status import UNDER_WAY, PenetrationStatus, Phase
from rotemina.app.motion.penetration.thrust import ThrustPlan
from rotemina.app.motion.session import MotionSession
from rotemina.sim.errors import InputError
from rotemina.sim.messages import marked, message


class Penetration(PenetrationSequence):
    """The state machine; it has no thread: someone calls :meth:`step`, at about 200 Hz.

    Every method may be called from any thread.

    Parameters
    ----------
    session : MotionSession
    log : RunLog, optional
        Where runs are kept.
    today : callable
        Return date and time, for the log.
    """

    def __init__(
        self,
        session: MotionSession,
        log: RunLog | None = None,
        *,
        today: Callable[[], datetime] = lambda: datetime.now(UTC),
    ) -> None:
        super().__init__(session, today)
        self._log = log

    def arm(self, parameters: PenetrationParameters, now_s: float) -> None:
        """Check everything, and reserve every axis; nothing moves until the button is pressed.

        Raises
        ------
        InputError
            If a run is under way or held, the device or robot cannot, the room left in the range
            or the tip's bounds do not allow it, or someone else drives an axis.
        """
        with self._lock:
            if (busy := self._busy()) is not None:
                raise RefusedError(busy)
            self._release()
            permit = self._session.permit()
            self._attempt = armed(self._session, parameters, OWNER)
            self._feed = AxisFeed(self._session, parameters.axis)
            self._permit = permit
            self._armed_until_s = now_s + parameters.armed_s
            self.status = PenetrationStatus(
                Phase.ARMED,
                armed_left_s=parameters.armed_s,
                run=self.status.run,
                trace=self.status.trace,
            )

    def why_not(self, parameters: PenetrationParameters, plan: ThrustPlan) -> str | None:
        """Return why :meth:`arm` would refuse parameters and their plan now; None: it would not.

        Nothing is reserved, and nothing waited for.
        """
        if (busy := self._busy()) is not None:
            return busy
        try:
            check_now(self._session, parameters, plan, OWNER)
        except InputError as error:
            return str(error)
        return None

    def _busy(self) -> str | None:
        phase = self.status.phase
        if phase not in UNDER_WAY | {Phase.HELD}:
            return None
        return message("engine", "a penetration is {phase}; end it first").fill(phase=phase)

    def disarm(self) -> None:
        """Set the axes free; after a hold, that leaves the tip where it is.

        Raises
        ------
        RefusedError
            While a run is under way: press the button first.
        """
        with self._lock:
            if self.status.phase in UNDER_WAY:
                raise RefusedError(
                    message("engine", "a penetration is in {phase}; stop it first").fill(
                        phase=self.status.phase
                    )
                )
            self._release()
            self._enter(Phase.DISARMED, 0.0)

    def close(self) -> None:
        """Have nothing more to do with the session; a run under way is held where it is."""
        with self._lock:
            if self.status.phase in UNDER_WAY:
                self._halt()
                self._hold_here(marked("engine", "the program released it"), self._since_s)
            self._release()
            self._end()
        self._write()

    def press(self, now_s: float) -> None:
        """Press the button: start when armed, retract during a run or a hold.

        Raises
        ------
        InputError
            If it is not armed, or the held tip cannot be moved now.
        """
        with self._lock:
            phase, attempt = self.status.phase, self._attempt
            if attempt is None or phase not in UNDER_WAY | {Phase.ARMED, Phase.HELD}:
                raise RefusedError(message("engine", "the penetration is not armed; arm it first"))
            if phase is Phase.ARMED:
                self._start(attempt, now_s)
            elif phase is Phase.HELD:
                self._retract_held(now_s)
            elif phase is Phase.RETRACT:
                self._halt()
                self._hold_here(
                    message("engine", "the retraction was stopped by the button"), now_s
                )
            else:
                self._back(
                    Verdict.ABORTED,
                    message("engine", "stopped by the button in {phase}").fill(phase=phase),
                    now_s,
                )

    def step(self, now_s: float) -> None:
        """Advance; ``now_s`` is the host's time. Never raises for errors of a device."""
        with self._lock:
            phase, attempt = self.status.phase, self._attempt
            if attempt is not None and phase in self._steps.keys() | {Phase.ARMED}:
                self._go_on(phase, attempt, now_s)
        self._write()

    def _start(self, attempt: Attempt, now_s: float) -> None:
        state = self._session.snapshot()
        broken = self._broken(state)
        if broken is not None:
            raise RefusedError(
                message("engine", "the penetration cannot start: {broken}").fill(broken=broken)
            )
        if state.command[attempt.parameters.axis] != attempt.start:
            raise RefusedError(
                message("engine", "the axis has moved since it was armed; arm it again")
            )
        attempt.began_s, attempt.started = now_s, self._today().isoformat()
        self._refusals.clear()
        self._renewed_s = float("-inf")
        self._enter(Phase.APPROACH, now_s)

    def _retract_held(self, now_s: float) -> None:
        permit = self._session.permit()
        state = self._session.snapshot()
        if state.locked is not None:
            raise RefusedError(
                message("engine", "the tip cannot be moved: {locked}").fill(locked=state.locked)
            )
        if not self._session.reservations.held_by(OWNER):
            raise RefusedError(
                message("engine", "the penetration no longer owns the axes; move them manually")
            )
        self._permit = permit
        self._outcome = (
            Verdict.ABORTED,
            message("engine", "retracted by the button; before: {reason}").fill(
                reason=self.status.reason
            ),
        )
        self._refusals.clear()
        self._enter(Phase.RETRACT, now_s)

    def _write(self) -> None:
        """Log an ended run; a full disk is reported, and stops nothing."""
        while self._unwritten:
            run = self._unwritten.popleft()
            try:
                if self._log is not None:
                    self._log.append(run)
            except InputError as error:
                with self._lock:
                    self.status = replace(self.status, problem=str(error))
