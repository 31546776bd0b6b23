"""Texts of the Control panel, and the parser of typed targets."""

from enum import StrEnum

from rotemina.app.language import find_noticeable_change, get_axis_label
from rotemina.app.motion.device import (
    HOMING,
    OPERATOR,
    PLAYBACK,
)
from rotemina.app.motion.limits import Range
from rotemina.app.motion.session import NamedInverse, OneSidedApproach
from rotemina.app.motion.state import SessionState
from rotemina.app.motion.teleoperation import TeleoperationState
from rotemina.app.panel import STALE_AGE_S
from rotemina.plugins.control import mark, tr
from rotemina.sim.kinematics import (
    MAX_SLOW_ZONE_SPEED_M_PER_S,
    SLOW_ZONE_HEIGHT_M,
    KeepOutZone,
)
from rotemina.sim.messages import (
    format_fixed,
    format_rounded,
    parse_number,
)
from rotemina.sim.robot import Axis
from rotemina.sim.units import DisplayScale, format_exact

# An axis is highlighted if less than this fraction of its range is left at one end.
NEAR_END_FRACTION = 0.1
# The engine's names of the joystick modes and scaling laws, marked here for translation.
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
_OWNERS_NOT_TAKEN_OVER = (OPERATOR, PLAYBACK, HOMING)


def is_stale(state: SessionState) -> bool:
    """Return whether the readings are too old to act on."""
    return state.age_s is None or state.age_s > STALE_AGE_S


def describe_age(age_s: float | None) -> str:
    """Return the age of an outdated reading as text."""
    if age_s is None:
        return tr("no data")
    if age_s < 100.0:
        return tr("{age:.1f} s old").format(age=age_s)
    return (
        tr("{age:.0f} min old").format(age=age_s / 60.0)
        if age_s < 6000.0
        else tr("{age:.0f} h old").format(age=age_s / 3600.0)
    )


def describe_status(axis: str, state: SessionState, scale: DisplayScale) -> str:
    """Return the most important information about an axis, other than its reading.

    This is its command, unless the axis is not homed or its readings are outdated.
    """
    if axis in state.unhomed:
        return tr("not homed")
    if is_stale(state) and state.measured:
        return describe_age(state.age_s)
    if not state.position_known or axis not in state.command:
        return ""
    return f"→ {scale.format_value(state.command[axis])}"


class DeviationGrade(StrEnum):
    """Severity of a difference between measured and commanded position."""

    PLAIN = "plain"
    APART = "apart"
    BEYOND = "beyond"


def grade_deviation(difference: float, axis: Axis) -> DeviationGrade:
    """Return the severity of a difference between measured and commanded position, m or rad.

    A ``PLAIN`` difference may be noise. ``BEYOND`` exceeds the following-error limit of the robot
    file. ``APART`` is in between.
    """
    if abs(difference) > axis.following_limit:
        return DeviationGrade.BEYOND
    return (
        DeviationGrade.APART
        if abs(difference) > find_noticeable_change(axis)
        else DeviationGrade.PLAIN
    )


def format_difference(difference: float, scale: DisplayScale) -> str:
    """Return measured minus commanded position, given in m or rad, as text with its sign."""
    text = scale.format_value(difference)
    return text if text.startswith("-") else f"+{text}"


def describe_compensation(
    inverse: NamedInverse | None, approach: OneSidedApproach | None, *, taken_up: bool
) -> tuple[str, str]:
    """Return symbols for the compensation that is active on an axis, and their explanation.

    ``taken_up`` says whether the backlash is taken up on the side of the approach.
    """
    symbols, explanations = [], []
    if inverse is not None:
        symbols.append("H⁻¹")
        text = tr(
            "H⁻¹: commands pass through the inverse {name}, which you can remove in the "
            "Compensation panel."
        )
        explanations.append(text.format(name=inverse.name))
    if approach is not None:
        arrow = "↑" if approach.rising else "↓"
        symbols.append(arrow if taken_up else f"({arrow})")
        explanation = (
            tr("{sign}: jogs and go-to moves approach their target from below.")
            if approach.rising
            else tr("{sign}: jogs and go-to moves approach their target from above.")
        )
        explanations.append(explanation.format(sign=arrow))
        if not taken_up:
            explanations.append(tr("In brackets: the last approach was from the other side."))
    return " ".join(symbols), " ".join(explanations)


def format_remaining_travel(position: float | None, ends: Range, scale: DisplayScale) -> str:
    """Return the distance to the nearer end of the range as text."""
    if position is None:
        return ""
    return tr("{way} left").format(
        way=_format_roughly(_compute_remaining_travel(position, ends), scale)
    )


def is_near_end(position: float | None, ends: Range) -> bool:
    """Return whether an axis is close to an end of its range."""
    return position is not None and _compute_remaining_travel(
        position, ends
    ) < NEAR_END_FRACTION * (ends[1] - ends[0])


def make_range_tooltip(axis: str, position: float | None, ends: Range, scale: DisplayScale) -> str:
    """Return a tooltip with the range of an axis and the remaining travel on both sides."""
    low, high = ends
    text = tr("{label} range: {low} … {high}").format(
        label=get_axis_label(axis),
        low=scale.format_with_unit(low),
        high=scale.format_with_unit(high),
    )
    if position is None:
        return text
    travel_down, travel_up = max(position - low, 0.0), max(high - position, 0.0)
    return tr("{range}; remaining: {down} down, {up} up").format(
        range=text, down=scale.format_with_unit(travel_down), up=scale.format_with_unit(travel_up)
    )


def _compute_remaining_travel(position: float, ends: Range) -> float:
    low, high = ends
    return max(min(position - low, high - position), 0.0)


def _format_roughly(value: float, scale: DisplayScale) -> str:
    return scale._replace(decimals=1).format_with_unit(value)


def parse_target(text: str, scale: DisplayScale) -> float | None:
    """Return the position in a text, m or rad; None if the text is not a plain number.

    A comma is accepted only if it is the decimal separator of the language: otherwise it could be
    a thousands separator.
    """
    number = parse_number(text)
    return None if number is None else number / scale.per_si


def echo_target(text: str, scale: DisplayScale) -> str:
    """Return the typed target with its unit, or the reason why the text is not a number."""
    if not text.strip():
        return ""
    target = parse_target(text, scale)
    if target is None:
        return tr("decimal point, no comma") if "," in text else tr("not a number")
    return tr("to {target}").format(target=scale.format_with_unit(target))


def format_distance(text: str, scale: DisplayScale, command: float | None) -> str:
    """Return the signed distance from the command to the typed target, or "" if it is unknown."""
    target = parse_target(text, scale)
    if target is None or command is None:
        return ""
    distance = scale.format_with_unit(target - command)
    return distance if distance.startswith("-") else f"+{distance}"


def explain_invalid_target(axis: str, text: str, scale: DisplayScale) -> str:
    """Return why a text is not a valid target."""
    return tr(
        "{label}: {text!r} is not a position; type a number in {symbol} with a decimal point."
    ).format(label=get_axis_label(axis), text=text.strip(), symbol=scale.symbol)


def describe_tip(state: SessionState, zone: KeepOutZone | None) -> str:
    """Describe the height of the tip, and whether it is in the slow zone, in a sentence."""
    if zone is None:
        return tr("No tip: this robot has no kinematic chain to a tip.")
    if state.tip is None or not state.position_known:
        return tr("Tip: unknown.")
    height_above_floor = compute_height_above_floor(state, zone)
    if height_above_floor is None:
        return tr("Tip at {height}; no floor is taught.").format(
            height=_format_millimetres(state.tip[2])
        )
    if height_above_floor < 0.0:
        return tr("Tip {height} below its floor.").format(
            height=_format_millimetres(-height_above_floor)
        )
    slow = tr("; slow zone") if height_above_floor < SLOW_ZONE_HEIGHT_M else ""
    return tr("Tip {height} above its floor{slow}.").format(
        height=_format_millimetres(height_above_floor), slow=slow
    )


def describe_tip_briefly(state: SessionState, zone: KeepOutZone | None) -> str:
    """Return the height of the tip as a short text."""
    if zone is None:
        return ""
    height_above_floor = compute_height_above_floor(state, zone)
    if height_above_floor is not None:
        return tr("Tip {height} above floor").format(height=_format_millimetres(height_above_floor))
    is_known = state.tip is not None and state.position_known
    return tr("No floor taught") if is_known else tr("Tip unknown")


def compute_height_above_floor(state: SessionState, zone: KeepOutZone | None) -> float | None:
    """Return the height of the tip above the floor, m.

    Return None if the tip position or the floor is unknown.
    """
    if zone is None or state.tip is None or not state.position_known:
        return None
    height = state.tip[2] - zone.low
    return height if abs(height) < float("inf") else None


def describe_bounds(zone: KeepOutZone | None) -> str:
    """Describe the limits on the position of the tip, and the slow zone."""
    if zone is None:
        return tr("Only the axis ranges limit this robot.")
    bounds = []
    if abs(zone.low) < float("inf"):
        bounds.append(tr("floor at {height}").format(height=_format_millimetres(zone.low)))
    if abs(zone.high) < float("inf"):
        bounds.append(tr("objective at {height}").format(height=_format_millimetres(zone.high)))
    if zone.radius < float("inf"):
        bounds.append(
            tr("at most {height} from the middle of the workspace").format(
                height=_format_millimetres(zone.radius)
            )
        )
    if not bounds:
        return tr(
            "Only the axis ranges limit the tip. To teach a floor, use the Tip section of "
            "the Connection panel."
        )
    slow = (
        tr(" Within {height} of the floor, the tip descends at {speed} at most.").format(
            height=format_exact(SLOW_ZONE_HEIGHT_M, "m"),
            speed=format_exact(MAX_SLOW_ZONE_SPEED_M_PER_S, "m/s"),
        )
        if abs(zone.low) < float("inf")
        else ""
    )
    text = ", ".join(bounds)
    return f"{text[:1].upper()}{text[1:]}.{slow}"


def _format_millimetres(metres: float) -> str:
    return f"{format_fixed(1e3 * metres, 4)} mm"


def find_takeable_axes(state: SessionState) -> tuple[str, ...]:
    """Return the axes that the operator may take over from another owner."""
    return tuple(
        axis for axis, owner in state.owners.items() if owner not in _OWNERS_NOT_TAKEN_OVER
    )


def describe_steering(state: TeleoperationState, device: str) -> str:
    """Describe the input device that moves the axes, its mode and its scaling."""
    mode, law = tr(state.mode), tr(state.law)
    return f"{device} · {mode} · {law} × {format_rounded(state.factor, 6)}"
