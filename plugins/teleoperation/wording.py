"""Texts of teleoperation: device in control, modes, laws and coordinates."""

from collections.abc import Collection
from dataclasses import replace
from typing import NamedTuple

from rotemina.app.language import choose_axis_scale, get_axis_label, translate_message
from rotemina.app.motion.inputs import (
    InputAxisView,
    InputDeviceView,
    InputDisplayState,
    OperatorAction,
    OperatorRole,
    PluggedDevice,
)
from rotemina.app.motion.teleoperation import (
    ALL_AXES_MODE,
    TIP_MODES,
    CoordinateView,
    ImpedanceLaw,
    LawKind,
    LinearPositionLaw,
    LinearRateLaw,
    TeleoperationState,
)
from rotemina.app.workbench import StateTone
from rotemina.plugins.teleoperation import mark, plain_units, tr
from rotemina.sim.messages import format_fixed
from rotemina.sim.robot import Robot
from rotemina.sim.units import DisplayScale, make_scale

PAD_SOURCE = "keys"

WAITING_TEXT = mark("centre the stick first")
# Re-centring is recommended if less than this fraction of the piezo range remains.
_LOW_RESERVE_RATIO = 0.2
# The tilt in rad is rounded to this many decimals, because smaller values are rounding errors.
_TILT_DECIMALS = 9
_TIP_SCALE = make_scale("mm", decimals=5)


class ButtonTexts(NamedTuple):
    """Texts of a button: its label and its tooltip."""

    text: str
    tip: str


_MODE_TEXTS = {
    "micro": ButtonTexts(
        mark("Micro"), mark("The stick moves the tables over millimetres in steps of 0.1 µm.")
    ),
    "nano": ButtonTexts(
        mark("Nano"), mark("The stick moves the piezos: two tilts and some micrometres along z.")
    ),
    "hybrid": ButtonTexts(
        mark("Hybrid z"),
        mark(
            "The stick moves the tip; along z the piezo moves within its range, the "
            "table does the rest."
        ),
    ),
    "fine": ButtonTexts(
        mark("Fine x/y"),
        mark("The stick moves the tip only by piezos: x and y by tilting the tool."),
    ),
    "pivot": ButtonTexts(
        mark("Pivot"), mark("The stick tilts the tool while the tables hold its tip in place.")
    ),
    ALL_AXES_MODE: ButtonTexts(
        mark("All axes"), mark("The stick moves the robot's first three axes.")
    ),
}
_LAW_TEXTS = {
    LawKind.POSITION: ButtonTexts(
        mark("Position"),
        mark("The stick's position sets the tip's position; when released, the tip returns."),
    ),
    LawKind.RATE: ButtonTexts(
        mark("Rate"), mark("The stick's position sets a speed; when released, the tip stops.")
    ),
    LawKind.IMPEDANCE: ButtonTexts(
        mark("Impedance"),
        mark("The stick pushes a virtual mass with or without a spring; a contact pushes back."),
    ),
}


def make_mode_texts(mode: str) -> ButtonTexts:
    """Return the texts of the button of a mode."""
    if mode in _MODE_TEXTS:
        return _translate_texts(_MODE_TEXTS[mode])
    tooltip = tr("The stick moves the axes of stage {mode!r}.")
    return ButtonTexts(mode.capitalize(), tooltip.format(mode=mode))


def list_law_texts() -> tuple[tuple[LawKind, ButtonTexts], ...]:
    """Return the laws with the texts of their buttons."""
    return tuple((kind, _translate_texts(texts)) for kind, texts in _LAW_TEXTS.items())


def _translate_texts(texts: ButtonTexts) -> ButtonTexts:
    return ButtonTexts(*(tr(text) for text in texts))


def name_device(device: PluggedDevice) -> str:
    """Return the name of a device for the operator."""
    return tr("On-screen pad") if device.identity.source == PAD_SOURCE else device.identity.name


def find_driving_devices(view: InputDisplayState) -> tuple[InputDeviceView, ...]:
    """Return the devices in control that have at least one mapped axis."""
    return tuple(
        device for device in view.devices if device.is_driving and _find_moving_axes(device)
    )


def name_driving_devices(view: InputDisplayState) -> str:
    """Return the names of the devices in control."""
    names = [name_device(device.device) for device in find_driving_devices(view)]
    return tr(" and ").join(names) or tr("No device in control")


def describe_trust(view: InputDisplayState) -> str:
    """Return whether the devices in control are active, or why they are not."""
    devices = find_driving_devices(view)
    if not devices:
        return next(
            map(translate_message, view.problems),
            tr("Plug in a device, or choose a profile for a connected one."),
        )
    reasons: dict[str, list[str]] = {}
    for device in devices:
        if device.problem is not None:
            reasons.setdefault(translate_message(device.problem), [])
        for axis in _find_moving_axes(device):
            if axis.reason is not None:
                reasons.setdefault(translate_message(axis.reason), []).append(str(axis.drives))
    parts = [
        f"{', '.join(get_axis_label(axis) for axis in axes)}: {reason}" if axes else reason
        for reason, axes in reasons.items()
    ]
    return tr("Not active: {parts}").format(parts="; ".join(parts)) if parts else tr("Active")


def describe_state(
    view: InputDisplayState, state: TeleoperationState, *, stale: bool
) -> tuple[str, StateTone]:
    """Return the state in one word, and its severity."""
    if stale:
        return tr("no answer"), StateTone.DANGER
    if state.is_driving:
        return tr("in control"), StateTone.BUSY
    if view.is_mapping_open:
        return tr("setting up"), StateTone.WARNING
    if state.reason is not None:
        return tr("blocked"), StateTone.WARNING
    if any(coordinate.is_waiting for coordinate in state.coordinates):
        return tr("waiting"), StateTone.WARNING
    # Green is reserved for a machine that is ready.
    return tr("input ready"), StateTone.QUIET


def explain_no_motion(state: TeleoperationState, *, stale: bool) -> str:
    """Return why nothing moves now, or how to move the robot."""
    if stale:
        return tr("The input devices do not respond: stop the machine and restart the program.")
    if state.reason is not None:
        return tr("Hand control waits: {reason}.").format(reason=translate_message(state.reason))
    return "" if state.is_driving else tr("The robot follows the stick.")


def find_pad_objection(view: InputDisplayState) -> str | None:
    """Return why the on-screen pad cannot move anything, or None.

    The state of the machine is not considered.
    """
    pad = find_pad(view)
    if pad is None:
        return tr("the input devices are being opened")
    if view.is_mapping_open:
        return tr("input devices are being set up")
    if pad.problem is not None:
        return translate_message(pad.problem)
    if pad.seat is None:
        return tr("the profile does not map the pad")
    if not pad.is_driving:
        return tr("{driver} is in control; take over to use the pad").format(
            driver=name_driving_devices(view)
        )
    return None


def find_pad(view: InputDisplayState) -> InputDeviceView | None:
    """Return the on-screen pad, or None before it has been opened."""
    pads = (device for device in view.devices if device.device.identity.source == PAD_SOURCE)
    return next(pads, None)


def is_trainee(pad: InputDeviceView | None) -> bool:
    """Return whether another device has priority and the pad may take over."""
    return pad is not None and pad.seat is OperatorRole.TRAINEE


def _find_moving_axes(device: InputDeviceView) -> tuple[InputAxisView, ...]:
    return tuple(axis for axis in device.axes if axis.drives is not None)


def format_factor(factor: float, held: Collection[OperatorAction]) -> str:
    """Return the current factor of all scales, and the held buttons that cause it."""
    names = ", ".join(
        translate_message(action)
        for action in (OperatorAction.FINE, OperatorAction.COARSE)
        if action in held
    )
    text = tr("now × {factor:g}").format(factor=factor)
    return f"{text} ({names})" if names else text


def describe_clutch(law: LawKind, held: Collection[OperatorAction]) -> str:
    """Return what the clutch does, or would do."""
    if OperatorAction.CLUTCH in held:
        return tr("Clutch pressed: the stick moves without the robot.")
    if law is LawKind.RATE:
        return tr("Release the stick to stop the robot in place.")
    return tr("Press the clutch (space on the pad) to return the stick without the robot.")


def name_coordinate(mode: str, name: str, unit: str) -> str:
    """Return the name of a coordinate, which belongs to the tip or to an axis."""
    return (
        tr("Tip {name}").format(name=name)
        if mode in TIP_MODES and unit == "m"
        else get_axis_label(name)
    )


def find_coordinate_scale(robot: Robot, mode: str, name: str, unit: str) -> DisplayScale:
    """Return the screen unit and the decimals of a coordinate."""
    if mode in TIP_MODES and unit == "m":
        return _TIP_SCALE
    return choose_axis_scale(robot.axes[name])


def describe_law(view: CoordinateView, moving_part: str, travel_m: float | None) -> str:
    """Return the current effect of full deflection.

    ``travel_m`` is the travel of the stick's grip, m, or None if it is unknown.
    """
    law, unit = view.law, view.unit
    if isinstance(law, LinearPositionLaw):
        distance = abs(law.factor * law.scale)
        if travel_m is not None:
            return plain_units.format_position_scale(
                _round_to_3_digits(distance), unit, moving_part, travel_m
            )
        return plain_units.format_full_deflection(_round_to_3_digits(distance), unit)
    if isinstance(law, LinearRateLaw):
        # With a coarse factor, full deflection may request more than the maximum speed.
        return plain_units.format_rate_scale(
            _round_to_3_digits(min(abs(law.factor * law.scale), law.bounds.max_speed)), unit
        )
    if isinstance(law, ImpedanceLaw):
        dynamics, factor = law.impedance.perceived_dynamics, law.effective_factor
        speed = dynamics.terminal_speed and _round_to_3_digits(factor * dynamics.terminal_speed)
        travel = dynamics.travel and _round_to_3_digits(factor * dynamics.travel)
        return plain_units.describe_dynamics(
            replace(dynamics, terminal_speed=speed, travel=travel), unit
        )
    return ""


def format_reserve(state: TeleoperationState) -> str:
    """Return the remaining piezo range, and advice if it is small."""
    if state.reserve is None:
        return tr("not available in this mode") if state.coordinates else "–"
    remaining = f"{format_fixed(100.0 * state.reserve, 0)} %"
    if state.reserve < _LOW_RESERVE_RATIO:
        remaining = tr("{left} – re-centre").format(left=remaining)
    return remaining


def describe_tilt(state: TeleoperationState) -> str:
    """Return the tilt of the tool since the mode began."""
    if state.tilt is None:
        return tr("not in this mode") if state.coordinates else "–"
    return plain_units.format_tilt(round(state.tilt, _TILT_DECIMALS))


def _round_to_3_digits(value: float) -> float:
    return float(f"{value:.3g}")
