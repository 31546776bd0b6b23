"""Teleoperation in words: who drives, modes, laws, places."""

from collections.abc import Collection
from dataclasses import replace
from typing import NamedTuple

from rotemina.app.display_units import axis_scale, label
from rotemina.app.motion.teleoperation.impedance import Impedance
from rotemina.app.motion.teleoperation.input_arbiter import DevicesView, DeviceView
from rotemina.app.motion.teleoperation.intent import Action
from rotemina.app.motion.teleoperation.linear_laws import LinearPosition, LinearRate
from rotemina.app.motion.teleoperation.mapped_device import AxisView
from rotemina.app.motion.teleoperation.modes import ALL_AXES, TIP_MODES
from rotemina.app.motion.teleoperation.profile import OperatorRole
from rotemina.app.motion.teleoperation.profile_check import PluggedDevice
from rotemina.app.motion.teleoperation.scales import LawKind
from rotemina.app.motion.teleoperation.teleoperation_state import CoordinateView, TeleoperationState
from rotemina.app.shell.engine_words import spoken
from rotemina.app.shell.state_tone import Tone
from rotemina.plugins.teleoperation import mark, plain_units, tr
from rotemina.sim.quantities import Scale, fixed, scale_in
from rotemina.sim.robot.model import Robot

PAD_SOURCE = "keys"

WAITING = mark("centre the stick first")
_LITTLE = 0.2  # of the range
_TILT_DIGITS = 9  # of rad: what is less is rounding, and no tilt
_TIP_SCALE = scale_in("mm", decimals=5)


class Choice(NamedTuple):
    """A choice of a button: its text, and one sentence about it."""

    text: str
    tip: str


_MODES = {
    "micro": Choice(
        mark("Micro"), mark("The stick moves the tables over millimetres in steps of 0.1 µm.")
    ),
    "nano": Choice(
        mark("Nano"), mark("The stick moves the piezos: two tilts and some micrometres along z.")
    ),
    "hybrid": Choice(
        mark("Hybrid z"),
        mark(
            "The stick moves the tip; along z the piezo moves within its range, the "
            "table does the rest."
        ),
    ),
    "fine": Choice(
        mark("Fine x/y"),
        mark("The stick moves the tip only by piezos: x and y by tilting the tool."),
    ),
    "pivot": Choice(
        mark("Pivot"), mark("The stick tilts the tool while the tables hold its tip in place.")
    ),
    ALL_AXES: Choice(mark("All axes"), mark("The stick moves the robot's first three axes.")),
}
_LAWS = {
    LawKind.POSITION: Choice(
        mark("Position"),
        mark("The stick's position sets the tip's position; when released, the tip returns."),
    ),
    LawKind.RATE: Choice(
        mark("Rate"), mark("The stick's position sets a speed; when released, the tip rests.")
    ),
    LawKind.IMPEDANCE: Choice(
        mark("Impedance"),
        mark("The stick pushes a virtual mass with or without a spring; a contact pushes back."),
    ),
}


def mode_choice(mode: str) -> Choice:
    """Return what to write on the button of a mode."""
    if mode in _MODES:
        return _shown(_MODES[mode])
    tip = tr("The stick moves the axes of stage {mode!r}.")
    return Choice(mode.capitalize(), tip.format(mode=mode))


def law_choices() -> tuple[tuple[LawKind, Choice], ...]:
    """Return the laws, and what to write on their buttons."""
    return tuple((kind, _shown(choice)) for kind, choice in _LAWS.items())


def _shown(choice: Choice) -> Choice:
    return Choice(*(tr(text) for text in choice))


# --- who drives -----------------------------------------------------------------------------------


def device_name(device: PluggedDevice) -> str:
    """Return how an operator calls a device."""
    return tr("On-screen pad") if device.identity.source == PAD_SOURCE else device.identity.name


def drivers(view: DevicesView) -> tuple[DeviceView, ...]:
    """Return the devices that drive: of the seat that does, those with an axis that moves."""
    return tuple(one for one in view.devices if one.drives and _moving(one))


def driver_text(view: DevicesView) -> str:
    """Return what drives, by name."""
    names = [device_name(one.device) for one in drivers(view)]
    return tr(" and ").join(names) or tr("No device in control")


def trust_text(view: DevicesView) -> str:
    """Return whether what drives is trusted, or why it is not."""
    found = drivers(view)
    if not found:
        return next(
            map(spoken, view.problems),
            tr("Plug in a device, or choose a profile for a connected one."),
        )
    reasons: dict[str, list[str]] = {}
    for device in found:
        if device.problem is not None:
            reasons.setdefault(spoken(device.problem), [])
        for axis in _moving(device):
            if axis.reason is not None:
                reasons.setdefault(spoken(axis.reason), []).append(str(axis.drives))
    parts = [
        f"{', '.join(label(axis) for axis in axes)}: {why}" if axes else why
        for why, axes in reasons.items()
    ]
    return tr("Not active: {parts}").format(parts="; ".join(parts)) if parts else tr("Active")


def standing(view: DevicesView, state: TeleoperationState, *, stale: bool) -> tuple[str, Tone]:
    """Return the state in one word, and its severity."""
    if stale:
        return tr("no answer"), Tone.DANGER
    if state.driving:
        return tr("in control"), Tone.BUSY
    if view.setting_up:
        return tr("setting up"), Tone.WARNING
    if state.reason is not None:
        return tr("blocked"), Tone.WARNING
    if any(one.waiting for one in state.coordinates):
        return tr("waiting"), Tone.WARNING
    return tr("input ready"), Tone.QUIET  # green is for a machine that is ready


def reason_text(state: TeleoperationState, *, stale: bool) -> str:
    """Return why nothing moves now, or what would make it move."""
    if stale:
        return tr("The input devices do not respond: stop the machine and restart the program.")
    if state.reason is not None:
        return tr("Hand control waits: {reason}.").format(reason=spoken(state.reason))
    return "" if state.driving else tr("Moves with the stick.")


def against_pad(view: DevicesView) -> str | None:
    """Why the pad on the screen moves nothing, whatever the machine does; None if it may."""
    pad = pad_of(view)
    if pad is None:
        return tr("the input devices are being opened")
    if view.setting_up:
        return tr("input devices are being set up")
    if pad.problem is not None:
        return spoken(pad.problem)
    if pad.seat is None:
        return tr("the profile does not map the pad")
    if not pad.drives:
        return tr("{driver} is in control; take over to use the pad").format(
            driver=driver_text(view)
        )
    return None


def pad_of(view: DevicesView) -> DeviceView | None:
    """Return the pad on the screen; None before it was opened."""
    pads = (one for one in view.devices if one.device.identity.source == PAD_SOURCE)
    return next(pads, None)


def is_trainee(pad: DeviceView | None) -> bool:
    """Whether someone else drives first, and the pad may take over."""
    return pad is not None and pad.seat is OperatorRole.TRAINEE


def _moving(device: DeviceView) -> tuple[AxisView, ...]:
    return tuple(axis for axis in device.axes if axis.drives is not None)


# --- scales ---------------------------------------------------------------------------------------


def factor_text(factor: float, held: Collection[Action]) -> str:
    """Return the factor on all scales that acts now."""
    names = ", ".join(spoken(one) for one in (Action.FINE, Action.COARSE) if one in held)
    now = tr("now × {factor:g}").format(factor=factor)
    return f"{now} ({names})" if names else now


def clutch_text(law: LawKind, held: Collection[Action]) -> str:
    """Return what the clutch does, or does at present."""
    if Action.CLUTCH in held:
        return tr("Clutch pressed: the stick moves without the robot.")
    if law is LawKind.RATE:
        return tr("Release the stick to stop the robot in place.")
    return tr("Press the clutch (space on the pad) to return the stick without the robot.")


# --- coordinates ----------------------------------------------------------------------------------


def coordinate_name(mode: str, name: str, unit: str) -> str:
    """Return what a coordinate is called: in some modes it is the tip's, and no axis."""
    return tr("Tip {name}").format(name=name) if mode in TIP_MODES and unit == "m" else label(name)


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
            return plain_units.position_text(_short(way), unit, what, travel_m)
        return plain_units.way_text(_short(way), unit)
    if isinstance(law, LinearRate):
        # A coarse factor asks for more than it gets.
        return plain_units.rate_text(
            _short(min(abs(law.factor * law.scale), law.bounds.max_speed)), unit
        )
    if isinstance(law, Impedance):
        felt, factor = law.impedance.felt, law.acting_factor
        speed = felt.terminal_speed and _short(factor * felt.terminal_speed)
        travel = felt.travel and _short(factor * felt.travel)
        return plain_units.felt_text(replace(felt, terminal_speed=speed, travel=travel), unit)
    return ""


def reserve_text(state: TeleoperationState) -> str:
    """Return how much of a piezo's range is left, and what to do where that is little."""
    if state.reserve is None:
        return tr("not shared in this mode") if state.coordinates else "–"
    left = f"{fixed(100.0 * state.reserve, 0)} %"
    if state.reserve < _LITTLE:
        left = tr("{left} – re-centre").format(left=left)
    return left


def tilt_shown(state: TeleoperationState) -> str:
    """Return by how much the tool was turned."""
    if state.tilt is None:
        return tr("not in this mode") if state.coordinates else "–"
    return plain_units.tilt_text(round(state.tilt, _TILT_DIGITS))


def _short(value: float) -> float:
    return float(f"{value:.3g}")
