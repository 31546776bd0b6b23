"""Text of the control menu for an axis, and parsing of a typed target."""

from enum import StrEnum

from rotemina.app.display_units import label, noticeable
from rotemina.app.motion.backlash import Approach
from rotemina.app.motion.compensation import NamedInverse
from rotemina.app.motion.ownership import HOMING, OPERATOR, PLAYBACK
from rotemina.app.motion.ranges import Range
from rotemina.app.motion.state import SessionState
from rotemina.app.motion.teleoperation.teleoperation_state import TeleoperationState
from rotemina.app.panel import STALE_S
from rotemina.plugins.control import mark, tr
from rotemina.sim.kinematics.keep_out import SLOW_HEIGHT, SLOW_SPEED, KeepOutZone
from rotemina.sim.quantities import Scale, exact, fixed, parsed, rounded
from rotemina.sim.robot.model import Axis

LITTLE = 0.1  # of the range: what is left below it is pointed at
# Modes and laws of the stick, as the engine names them.
MODES_AND_LAWS = (
    mark("micro"),
    mark("nano"),
    mark("hybrid"),
    mark("fine"),
    mark("pivot"),
    mark("position"),
    mark("rate"),
    mark("impedance"),
)
_NOT_TAKEN = (OPERATOR, PLAYBACK, HOMING)


# --- readouts -------------------------------------------------------------------------------------


def is_stale(state: SessionState) -> bool:
    """Whether the readings are too old to act on."""
    return state.age_s is None or state.age_s > STALE_S


def age_text(age_s: float | None) -> str:
    """Return how old a reading is that is too old."""
    if age_s is None:
        return tr("no data")
    if age_s < 100.0:
        return tr("{age:.1f} s old").format(age=age_s)
    return (
        tr("{age:.0f} min old").format(age=age_s / 60.0)
        if age_s < 6000.0
        else tr("{age:.0f} h old").format(age=age_s / 3600.0)
    )


def status_text(axis: str, state: SessionState, scale: Scale) -> str:
    """Return the one thing that matters most of an axis, beside its reading.

    Who drives it stands in the header: here there is room for the command alone.
    """
    if axis in state.unhomed:
        return tr("not homed")
    if is_stale(state) and state.measured:
        return age_text(state.age_s)
    if not state.position_known or axis not in state.command:
        return ""
    return f"→ {scale.number(state.command[axis])}"


class Grade(StrEnum):
    """How grave it is that a reading is not where its axis was sent."""

    PLAIN = "plain"
    APART = "apart"
    BEYOND = "beyond"


def grade_of(apart: float, axis: Axis) -> Grade:
    """Return how grave a difference (SI) is.

    Plain is what noise makes. Beyond is what the following bound of the robot file does not allow.
    """
    if abs(apart) > axis.following:
        return Grade.BEYOND
    return Grade.APART if abs(apart) > noticeable(axis) else Grade.PLAIN


def difference_text(apart: float, scale: Scale) -> str:
    """Return how far a reading is from the command (SI), with its sign."""
    text = scale.number(apart)
    return text if text.startswith("-") else f"+{text}"


def aids(
    inverse: NamedInverse | None, approach: Approach | None, *, taken_up: bool
) -> tuple[str, str]:
    """Return signs of what stands between an axis' command and the machine, and what they mean."""
    signs, meant = [], []
    if inverse is not None:
        signs.append("H⁻¹")
        text = tr("H⁻¹: commands pass the inverse {name}; remove it in the panel Compensation.")
        meant.append(text.format(name=inverse.name))
    if approach is not None:
        arrow = "↑" if approach.rising else "↓"
        signs.append(arrow if taken_up else f"({arrow})")
        side = (
            tr("{sign}: jogs and go-to approach from below.")
            if approach.rising
            else tr("{sign}: jogs and go-to approach from above.")
        )
        meant.append(side.format(sign=arrow))
        if not taken_up:
            meant.append(tr("In brackets: the last approach was from the other side."))
    return " ".join(signs), " ".join(meant)


def room_left_text(position: float | None, ends: Range, scale: Scale) -> str:
    """Return how far it is to the nearer end of the range."""
    if position is None:
        return ""
    return tr("{way} left").format(way=_rough(_left(position, ends), scale))


def is_little(position: float | None, ends: Range) -> bool:
    """Whether an axis is close to an end of its range."""
    return position is not None and _left(position, ends) < LITTLE * (ends[1] - ends[0])


def range_tip(axis: str, position: float | None, ends: Range, scale: Scale) -> str:
    """Return the range of an axis, and the travel left on both sides."""
    low, high = ends
    text = tr("{label} range: {low} … {high}").format(
        label=label(axis), low=scale.text(low), high=scale.text(high)
    )
    if position is None:
        return text
    down, up = max(position - low, 0.0), max(high - position, 0.0)
    return tr("{range}; remaining: {down} down, {up} up").format(
        range=text, down=scale.text(down), up=scale.text(up)
    )


def _left(position: float, ends: Range) -> float:
    low, high = ends
    return max(min(position - low, high - position), 0.0)


def _rough(value: float, scale: Scale) -> str:
    return scale._replace(decimals=1).text(value)


# --- typed targets --------------------------------------------------------------------------------


def typed(text: str, scale: Scale) -> float | None:
    """Return the position (SI) that a text means; None if it is no plain number.

    A comma is refused where it is not the decimal sign: it may be a thousands separator.
    """
    number = parsed(text)
    return None if number is None else number / scale.per_si


def echo(text: str, scale: Scale) -> str:
    """Return what a typed text means, with its unit."""
    if not text.strip():
        return ""
    target = typed(text, scale)
    if target is None:
        return tr("decimal point, no comma") if "," in text else tr("not a number")
    return tr("to {target}").format(target=scale.text(target))


def way(text: str, scale: Scale, command: float | None) -> str:
    """Return how far from here the typed position is; empty where that is not known."""
    target = typed(text, scale)
    if target is None or command is None:
        return ""
    distance = scale.text(target - command)
    return distance if distance.startswith("-") else f"+{distance}"


def no_position(axis: str, text: str, scale: Scale) -> str:
    """Return why a text moves nothing."""
    return tr(
        "{label}: {text!r} is not a position; type a number in {symbol} with a decimal point."
    ).format(label=label(axis), text=text.strip(), symbol=scale.symbol)


# --- tip ------------------------------------------------------------------------------------------


def tip_text(state: SessionState, zone: KeepOutZone | None) -> str:
    """Return where the tip is, and what is below it."""
    if zone is None:
        return tr("No tip: this robot has no kinematic chain to a tip.")
    if state.tip is None or not state.position_known:
        return tr("Tip: unknown.")
    above = above_floor(state, zone)
    if above is None:
        return tr("Tip at {height}; no floor is taught.").format(height=_millimetres(state.tip[2]))
    if above < 0.0:
        return tr("Tip {height} below its floor.").format(height=_millimetres(-above))
    slow = tr("; slow zone") if above < SLOW_HEIGHT else ""
    return tr("Tip {height} above its floor{slow}.").format(height=_millimetres(above), slow=slow)


def tip_short(state: SessionState, zone: KeepOutZone | None) -> str:
    """Return the tip's height in few letters."""
    if zone is None:
        return ""
    above = above_floor(state, zone)
    if above is not None:
        return tr("Tip over floor {height}").format(height=_millimetres(above))
    known = state.tip is not None and state.position_known
    return tr("No floor taught") if known else tr("Tip unknown")


def above_floor(state: SessionState, zone: KeepOutZone | None) -> float | None:
    """Return the height of the tip above its floor, m; None where one of them is not known."""
    if zone is None or state.tip is None or not state.position_known:
        return None
    height = state.tip[2] - zone.low
    return height if abs(height) < float("inf") else None


def bounds_text(zone: KeepOutZone | None) -> str:
    """Return what bounds the tip, and what the slow zone means."""
    if zone is None:
        return tr("Only the axis ranges limit this robot.")
    bounds = []
    if abs(zone.low) < float("inf"):
        bounds.append(tr("floor at {height}").format(height=_millimetres(zone.low)))
    if abs(zone.high) < float("inf"):
        bounds.append(tr("objective at {height}").format(height=_millimetres(zone.high)))
    if zone.radius < float("inf"):
        bounds.append(
            tr("at most {height} from the middle").format(height=_millimetres(zone.radius))
        )
    if not bounds:
        return tr("Only the axis ranges limit the tip. Teach a floor in Connection, Tip.")
    slow = (
        tr(" Within {height} above the floor it descends at {speed} at most.").format(
            height=exact(SLOW_HEIGHT, "m"), speed=exact(SLOW_SPEED, "m/s")
        )
        if abs(zone.low) < float("inf")
        else ""
    )
    text = ", ".join(bounds)
    return f"{text[:1].upper()}{text[1:]}.{slow}"


def _millimetres(metres: float) -> str:
    return f"{fixed(1e3 * metres, 4)} mm"


# --- owners ---------------------------------------------------------------------------------------


def taken(state: SessionState) -> tuple[str, ...]:
    """Return the axes that someone else drives from whom they may be taken over."""
    return tuple(axis for axis, owner in state.owners.items() if owner not in _NOT_TAKEN)


def steering_text(state: TeleoperationState, device: str) -> str:
    """Return what drives, and how."""
    mode, law = tr(state.mode), tr(state.law)
    return f"{device} · {mode} · {law} × {rounded(state.factor, 6)}"
