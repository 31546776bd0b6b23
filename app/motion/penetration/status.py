"""The status of a penetration for the operator."""

from dataclasses import dataclass
from enum import StrEnum

from rotemina.app.motion.penetration.run_log import PenetrationRun
from rotemina.app.motion.penetration.thrust import ThrustTrace


class Phase(StrEnum):
    """How far a penetration is."""

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
    HELD = "held"  # by a stop, a fault or a lost link: it stays where it is until somebody decides


#: Phases in which a run is under way.
UNDER_WAY = frozenset(
    {
        Phase.APPROACH,
        Phase.CONTACT,
        Phase.THRUST,
        Phase.HOLD,
        Phase.INJECT,
        Phase.HOLD_AFTER,
        Phase.RETRACT,
    }
)


@dataclass(frozen=True, slots=True)
class PenetrationStatus:
    """The state of a penetration at one moment.

    Attributes
    ----------
    phase : Phase
    reason : str
        Why it is in this phase, or what it waits for; empty where the phase says all.
    armed_left_s : float or None
        Until it disarms by itself.
    way : float or None
        How far the axis is commanded from where the run began, m.
    deviation : float or None
        Change of ``meas − model`` since the run began, against the motion, m.
    load : float or None
        How far the axis is from where it should be, m; ``overload`` of the parameters ends the run.
    run : PenetrationRun or None
        The latest run that has ended.
    trace : ThrustTrace or None
        Of the latest thrust that could be compared with its profile.
    problem : str
        Why the latest run could not be logged; empty if it was.
    """

    phase: Phase = Phase.DISARMED
    reason: str = ""
    armed_left_s: float | None = None
    way: float | None = None
    deviation: float | None = None
    load: float | None = None
    run: PenetrationRun | None = None
    trace: ThrustTrace | None = None
    problem: str = ""
