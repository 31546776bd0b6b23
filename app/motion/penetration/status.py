"""Phases and status of a penetration, as shown to the operator."""

from dataclasses import dataclass
from enum import StrEnum

from rotemina.app.motion.penetration.run_log import PenetrationRun
from rotemina.app.motion.penetration.thrust import ThrustTrace


class PenetrationPhase(StrEnum):
    """Phase of a penetration."""

    DISARMED = "disarmed"
    ARMED = "armed"
    APPROACH = "approach"
    CONTACT = "contact"
    THRUST = "thrust"
    HOLD = "hold"
    INJECT = "inject"
    HOLD_AFTER = "hold after"
    RETRACT = "retract"
    DONE = "done"
    ABORTED = "aborted"
    FAILED = "failed"
    # A stop, a fault or a lost link ended the run; the tip stays where it is until the operator
    # decides what to do.
    HELD = "held"


#: Phases in which a run is under way.
RUNNING_PHASES = frozenset(
    {
        PenetrationPhase.APPROACH,
        PenetrationPhase.CONTACT,
        PenetrationPhase.THRUST,
        PenetrationPhase.HOLD,
        PenetrationPhase.INJECT,
        PenetrationPhase.HOLD_AFTER,
        PenetrationPhase.RETRACT,
    }
)


@dataclass(frozen=True, slots=True)
class PenetrationStatus:
    """State of a penetration at one moment.

    Attributes
    ----------
    phase : PenetrationPhase
    reason : str
        Why the penetration is in this phase, or what it waits for. Empty if there is no reason.
    armed_remaining_s : float or None
        Time until the penetration is disarmed automatically.
    travel : float or None
        Distance of the commanded position from the start of the run, m.
    deviation : float or None
        Change of ``meas − model`` since the run began, m, positive against the motion.
    load : float or None
        Change of ``meas − command`` since the contact, or before it since the start, m. The run
        ends if this exceeds the parameter ``overload``.
    run : PenetrationRun or None
        The latest run that has ended.
    trace : ThrustTrace or None
        Trace of the latest thrust that could be compared with its profile.
    log_problem : str
        Why the latest run could not be logged. Empty if it was logged.
    """

    phase: PenetrationPhase = PenetrationPhase.DISARMED
    reason: str = ""
    armed_remaining_s: float | None = None
    travel: float | None = None
    deviation: float | None = None
    load: float | None = None
    run: PenetrationRun | None = None
    trace: ThrustTrace | None = None
    log_problem: str = ""
