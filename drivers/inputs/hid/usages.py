"""The HID usages of axes, hats and buttons, and their names."""

from hid_parser.data import (  # type: ignore[import-untyped]  # it has no types
    GenericDesktopControls,
    UsagePages,
)

_DESKTOP: int = UsagePages.GENERIC_DESKTOP_CONTROLS_PAGE << 16
_SIMULATION: int = UsagePages.SIMULATION_CONTROLS_PAGE << 16
_BUTTON: int = UsagePages.BUTTON_PAGE << 16

#: Top-level collections that an operator can steer with.
APPLICATIONS = frozenset(
    _DESKTOP | usage
    for usage in (
        GenericDesktopControls.JOYSTICK,
        GenericDesktopControls.GAMEPAD,
        GenericDesktopControls.MULTI_AXIS_CONTROLLER,
    )
)

# hid-parser has no names for this page (HID Usage Tables 1.5, section 5).
_SIMULATION_AXES = {
    0xB0: "Aileron",
    0xB5: "Collective",
    0xB8: "Elevator",
    0xBA: "Rudder",
    0xBB: "Throttle",
    0xC4: "Accelerator",
    0xC5: "Brake",
    0xC6: "Clutch",
    0xC8: "Steering",
    0xCB: "Front brake",
}
_AXES = {
    **{
        _DESKTOP | usage: str(GenericDesktopControls.get_description(usage))
        for usage in range(GenericDesktopControls.X, GenericDesktopControls.WHEEL + 1)
    },
    **{_SIMULATION | usage: name for usage, name in _SIMULATION_AXES.items()},
}
#: A hat switch, which is two axes.
HAT = _DESKTOP | GenericDesktopControls.HAT_SWITCH
_PAD_BUTTONS = {
    _DESKTOP | usage: str(GenericDesktopControls.get_description(usage))
    for usage in (
        GenericDesktopControls.START,
        GenericDesktopControls.SELECT,
        GenericDesktopControls.DPAD_UP,
        GenericDesktopControls.DPAD_DOWN,
        GenericDesktopControls.DPAD_RIGHT,
        GenericDesktopControls.DPAD_LEFT,
    )
}
# Relative, they tell notches turned and are nowhere: that is no deflection.
_TURNED = frozenset(
    _DESKTOP | usage
    for usage in (
        GenericDesktopControls.SLIDER,
        GenericDesktopControls.DIAL,
        GenericDesktopControls.WHEEL,
    )
)


def axis_name(usage: int, relative: bool) -> str | None:
    """Return the name of an axis, or None for another usage.

    A stick that calls itself relative, as 6-axis controllers do, tells its deflection all the same.
    """
    return None if relative and usage in _TURNED else _AXES.get(usage)


def button_name(usage: int) -> str | None:
    """Return the name of a button, or None, as for number 0 of the button page."""
    if usage & ~0xFFFF == _BUTTON and usage != _BUTTON:
        return f"Button {usage & 0xFFFF}"
    return _PAD_BUTTONS.get(usage)
