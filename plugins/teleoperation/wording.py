"""Teleoperation in words: who drives, modes, laws, places. Free of Qt."""

from collections.abc import Collection
from dataclasses import replace
from typing import NamedTuple

from rotemina.app.display import Scale, axis_scale, label
from rotemina.app.motion.teleoperation.devices_view import DevicesView
from rotemina.app.motion.teleoperation.impedance import Impedance
from rotemina.app.motion.teleoperation.intent import Action
from rotemina.app.motion.teleoperation.linear_position import LinearPosition
from rotemina.app.motion.teleoperation.linear_rate import LinearRate
from rotemina.app.motion.teleoperation.mapped_device import AxisView
from rotemina.app.motion.teleoperation.mapping import PluggedDevice
from rotemina.app.motion.teleoperation.modes import ALL_AXES, TIP_MODES
from rotemina.app.motion.teleoperation.operator_desk import DeviceView
from rotemina.app.motion.teleoperation.plain_units import (
    felt_text,
    position_text,
    rate_text,
    tilt_text,
)
from rotemina.app.motion.teleoperation.profile import Seat
from rotemina.app.motion.teleoperation.scales import LawKind
from rotemina.app.motion.teleoperation.views import CoordinateView, TeleoperationState
from rotemina.app.shell.phase import Tone
from rotemina.sim.robot.model import Robot
from rotemina.sim.trajectory.wording import readable

PAD_SOURCE = "keys"
WAITING = "bring the stick to the middle first"
_LITTLE = 0.2  # of the range
_TILT_DIGITS = 9  # of rad: what is less is rounding, and no tilt
_TIP_SCALE = Scale("mm", 5)


class Choice(NamedTuple):
    """A choice that a button offers: what stands on it, and one sentence about it."""

    text: str
    tip: str


_MODES = {
    "micro": Choice("Micro", "The stick moves the tables: millimetres, in steps of 0.1 µm."),
    "nano": Choice("Nano", "The stick moves the piezos: two tilts, and micrometres along z."),
    "hybrid": Choice(
        "Hybrid z",
        "The stick moves the tip: along z the piezo takes what fits and the table the rest.",
    ),
    "fine": Choice(
        "Fine x/y",
        "The stick moves the tip by piezos alone: x and y by tilting the tool, which costs its "
        "orientation.",
    ),
    "pivot": Choice(
        "Pivot",
        "The stick tilts the tool while the tables hold its tip where it is.",
    ),
    ALL_AXES: Choice("All axes", "The stick moves the robot's first three axes."),
}
LAWS = {
    LawKind.POSITION: Choice(
        "Position", "The stick's place is the tip's place: let go, and it comes back."
    ),
    LawKind.RATE: Choice("Rate", "The stick's place is a speed: let go, and it rests."),
    LawKind.IMPEDANCE: Choice(
        "Impedance",
        "The stick pushes a virtual mass, which glides or is on a spring; a contact pushes back.",
    ),
}


def mode_choice(mode: str) -> Choice:
    """Return what to write on the button of a mode."""
    other = Choice(mode.capitalize(), f"The stick moves the axes of stage {mode!r}.")
    return _MODES.get(mode, other)


# --- who drives -----------------------------------------------------------------------------------


def device_name(device: PluggedDevice) -> str:
    """Return how an operator calls a device."""
    return "On-screen pad" if device.identity.source == PAD_SOURCE else device.identity.name


def drivers(view: DevicesView) -> tuple[DeviceView, ...]:
    """Return the devices that drive: of the seat that does, those with an axis that moves."""
    return tuple(one for one in view.devices if one.drives and _moving(one))


def driver_text(view: DevicesView) -> str:
    """Return what drives, by name."""
    names = [device_name(one.device) for one in drivers(view)]
    return " and ".join(names) or "No device drives"


def trust_text(view: DevicesView) -> str:
    """Return whether what drives is trusted, or why it is not."""
    found = drivers(view)
    if not found:
        return next(iter(view.problems), "Plug one in, or choose a profile for what is there.")
    reasons: dict[str, list[str]] = {}
    for device in found:
        if device.problem is not None:
            reasons.setdefault(device.problem, [])
        for axis in _moving(device):
            if axis.reason is not None:
                reasons.setdefault(axis.reason, []).append(str(axis.drives))
    parts = [
        f"{', '.join(label(axis) for axis in axes)}: {why}" if axes else why
        for why, axes in reasons.items()
    ]
    return f"Not trusted: {'; '.join(parts)}" if parts else "Trusted"


def standing(view: DevicesView, state: TeleoperationState, *, stale: bool) -> tuple[str, Tone]:
    """Return how it stands in one word, and how grave that is."""
    if stale:
        return "no answer", Tone.DANGER
    if state.driving:
        return "driving", Tone.BUSY
    if view.setting_up:
        return "setting up", Tone.WARNING
    if state.reason is not None:
        return "held", Tone.WARNING
    if any(one.waiting for one in state.coordinates):
        return "waiting", Tone.WARNING
    return "ready", Tone.GOOD


def reason_text(state: TeleoperationState, *, stale: bool) -> str:
    """Return why nothing moves now, or what would make it move."""
    if stale:
        return "The loop of the input devices does not answer: stop, and start the program anew."
    if state.reason is not None:
        return f"Nothing moves: {state.reason}."
    return "" if state.driving else "Moves when the stick does."


def against_pad(view: DevicesView) -> str | None:
    """Why the pad on the screen moves nothing, whatever the machine does; None if it may."""
    pad = pad_of(view)
    if pad is None:
        return "the input devices are just being opened"
    if view.setting_up:
        return "input devices are being set up"
    if pad.problem is not None:
        return pad.problem
    if pad.seat is None:
        return "the profile has nothing for the pad"
    if not pad.drives:
        return f"{driver_text(view)} drives; take over to use the pad"
    return None


def pad_of(view: DevicesView) -> DeviceView | None:
    """Return the pad on the screen; None before it was opened."""
    pads = (one for one in view.devices if one.device.identity.source == PAD_SOURCE)
    return next(pads, None)


def is_trainee(pad: DeviceView | None) -> bool:
    """Whether somebody else drives first, and the pad may take over."""
    return pad is not None and pad.seat is Seat.TRAINEE


def _moving(device: DeviceView) -> tuple[AxisView, ...]:
    return tuple(axis for axis in device.axes if axis.drives is not None)


# --- scales ---------------------------------------------------------------------------------------


def factor_text(factor: float, held: Collection[Action]) -> str:
    """Return the factor on all scales that acts now."""
    names = ", ".join(one for one in (Action.FINE, Action.COARSE) if one in held)
    return f"now × {factor:g}{f' ({names})' if names else ''}"


def clutch_text(law: LawKind, held: Collection[Action]) -> str:
    """Return what the clutch does, or does just now."""
    if Action.CLUTCH in held:
        return "Clutch held: the stick moves, the robot does not."
    if law is LawKind.RATE:
        return "Let go of the stick, and the robot rests where it is."
    return "Hold the clutch (space on the pad) to bring the stick back without the robot."


# --- coordinates ----------------------------------------------------------------------------------


def coordinate_name(mode: str, name: str, unit: str) -> str:
    """Return what a coordinate is called: in some modes it is the tip's, and no axis."""
    return f"Tip {name}" if mode in TIP_MODES and unit == "m" else label(name)


def coordinate_scale(robot: Robot, mode: str, name: str, unit: str) -> Scale:
    """Return unit and digits of a coordinate."""
    if mode in TIP_MODES and unit == "m":
        return _TIP_SCALE
    return axis_scale(robot.axes[name])


def law_text(view: CoordinateView, what: str, travel_m: float | None) -> str:
    """Return what full deflection means now.

    ``what`` is what moves; ``travel_m`` the way of the stick's grip, m, where it is known.
    """
    law, unit = view.law, view.unit
    if isinstance(law, LinearPosition):
        way = abs(law.factor * law.scale)
        if travel_m is not None:
            return position_text(_short(way), unit, what, travel_m)
        return f"full stick = {readable(_short(way), unit)}"
    if isinstance(law, LinearRate):
        # A coarse factor asks for more than it gets.
        return rate_text(_short(min(abs(law.factor * law.scale), law.bounds.max_speed)), unit)
    if isinstance(law, Impedance):
        felt, factor = law.impedance.felt, law.acting_factor
        speed = felt.terminal_speed and _short(factor * felt.terminal_speed)
        travel = felt.travel and _short(factor * felt.travel)
        return felt_text(replace(felt, terminal_speed=speed, travel=travel), unit)
    return ""


def reserve_text(state: TeleoperationState) -> str:
    """Return how much of a piezo's range is left, and what to do where that is little."""
    if state.reserve is None:
        return "not shared in this mode" if state.coordinates else "–"
    return f"{100.0 * state.reserve:.0f} %{' – re-centre' if state.reserve < _LITTLE else ''}"


def tilt_shown(state: TeleoperationState) -> str:
    """Return by how much the tool was turned."""
    if state.tilt is None:
        return "not by this mode" if state.coordinates else "–"
    return tilt_text(round(state.tilt, _TILT_DIGITS))


def _short(value: float) -> float:
    return float(f"{value:.3g}")
