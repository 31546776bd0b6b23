"""What the engine says in fixed words, for the window's language: why nothing moves, who drives.

The engine speaks English. What it says once, such as a refusal or a fault, is shown as it is; what
stands in the window for long is among these.
"""

import re

from rotemina.app.shell.language import marked, translate

# Whole sayings of the engine, with what changes in them as ``{fields}``.
SAYINGS = (
    marked("shell", "not connected; connect first"),
    marked("shell", "connecting; wait"),
    marked("shell", "the device failed ({fault}); reconnect, then check where it stands"),
    marked("shell", "the device reports a fault ({fault}); clear it first"),
    marked("shell", "the device does not answer; wait until it does"),
    marked(
        "shell",
        "the device's parameters are not those of the robot file ({difference}); "
        "write or accept them first",
    ),
    marked("shell", "the position of {axes} is not known; home first"),
    marked("shell", "the position is not known yet"),
    marked("shell", "{reason}: the position may be wrong; home, or confirm it"),
    marked("shell", "the device has sent nothing for {seconds} s; wait, or reconnect"),
    marked("shell", "{stop} is latched; release it first"),
    marked("shell", "this is a replay; nothing moves"),
    marked("shell", "operator"),
    marked("shell", "playback"),
    marked("shell", "homing"),
    marked("shell", "joystick"),
    marked("shell", "penetration"),
    marked("shell", "emergency stop"),
    marked("shell", "the joystick's emergency stop"),
    marked("shell", "the connection was lost"),
)
_FIELD = re.compile(r"\\\{(\w+)\\\}")
_PATTERNS = tuple(
    (re.compile(_FIELD.sub(r"(?P<\1>.+)", re.escape(saying)), re.DOTALL), saying)
    for saying in SAYINGS
)


def spoken(text: str) -> str:
    """Return what the engine says in the window's language; what is not known here, unchanged."""
    for pattern, saying in _PATTERNS:
        found = pattern.fullmatch(text)
        if found is not None:
            fields = {name: spoken(value) for name, value in found.groupdict().items()}
            return translate("shell", saying).format(**fields)
    return text
