"""HID usages of axes, hats and buttons, and their names."""

from hid_parser.data import (  # type: ignore[import-untyped]  # it has no types
    GenericDesktopControls,
    UsagePages,
)

_DESKTOP_PAGE: int = UsagePages.GENERIC_DESKTOP_CONTROLS_PAGE << 16
_SIMULATION_PAGE: int = UsagePages.SIMULATION_CONTROLS_PAGE << 16
_BUTTON_PAGE: int = UsagePages.BUTTON_PAGE << 16

#: Usages of the top-level collections of joysticks and similar devices.
JOYSTICK_APPLICATIONS = frozenset(
    _DESKTOP_PAGE | usage
    for usage in (
        GenericDesktopControls.JOYSTICK,
        GenericDesktopControls.GAMEPAD,
        GenericDesktopControls.MULTI_AXIS_CONTROLLER,
    )
)

# Names from HID Usage Tables 1.5, section 5; hid-parser has none for this page.
_SIMULATION_AXIS_NAMES = {
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
_AXIS_NAMES = {
    **{
        _DESKTOP_PAGE | usage: str(GenericDesktopControls.get_description(usage))
        for usage in range(GenericDesktopControls.X, GenericDesktopControls.WHEEL + 1)
    },
    **{_SIMULATION_PAGE | usage: name for usage, name in _SIMULATION_AXIS_NAMES.items()},
}
#: Usage of a hat switch, which becomes two axes.
HAT_USAGE = _DESKTOP_PAGE | GenericDesktopControls.HAT_SWITCH
_PAD_BUTTON_NAMES = {
    _DESKTOP_PAGE | usage: str(GenericDesktopControls.get_description(usage))
    for usage in (
        GenericDesktopControls.START,
        GenericDesktopControls.SELECT,
        GenericDesktopControls.DPAD_UP,
        GenericDesktopControls.DPAD_DOWN,
        GenericDesktopControls.DPAD_RIGHT,
        GenericDesktopControls.DPAD_LEFT,
    )
}
# If these are relative, they report rotations and have no position, so they are not axes.
_ROTARY_USAGES = frozenset(
    _DESKTOP_PAGE | usage
    for usage in (
        GenericDesktopControls.SLIDER,
        GenericDesktopControls.DIAL,
        GenericDesktopControls.WHEEL,
    )
)


def find_axis_name(usage: int, relative: bool) -> str | None:
    """Return the name of an axis, or None for any other usage.

    Some sticks, such as those of 6-axis controllers, are declared as relative although they report
    their deflection.
    """
    return None if relative and usage in _ROTARY_USAGES else _AXIS_NAMES.get(usage)


def find_button_name(usage: int) -> str | None:
    """Return the name of a button, or None for any other usage.

    Usage 0 of the button page means "no button".
    """
    if usage & ~0xFFFF == _BUTTON_PAGE and usage != _BUTTON_PAGE:
        return f"Button {usage & 0xFFFF}"
    return _PAD_BUTTON_NAMES.get(usage)
