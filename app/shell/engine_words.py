"""What the engine says in fixed words, for the window's language: why nothing moves, who drives.

The engine speaks English. What it says once, such as a refusal or a fault, is shown as it is; what
stands in the window for long is among these.
"""

import re
from collections.abc import Callable, Collection

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
    marked("shell", "motion is locked: {reason}"),
    marked("shell", "operator"),
    marked("shell", "playback"),
    marked("shell", "homing"),
    marked("shell", "joystick"),
    marked("shell", "penetration"),
    marked("shell", "emergency stop"),
    marked("shell", "the joystick's emergency stop"),
    marked("shell", "the connection was lost"),
    # why somebody stopped
    marked("shell", "the joystick's stop"),
    marked("shell", "the window does not answer"),
    marked("shell", "the device is let go of"),
    marked("shell", "another device is connected"),
    marked("shell", "the input devices are let go of"),
    marked("shell", "the playback is paused"),
    marked("shell", "the playback is ended"),
    marked("shell", "the calibration is given up"),
    marked("shell", "it was stopped"),
)
_FIELD = re.compile(r"\\\{(\w+)\\\}")


def speaker(
    context: str, sayings: Collection[str], others: Callable[[str], str] = str
) -> Callable[[str], str]:
    """Return a function that says in the window's language what the engine says.

    Parameters
    ----------
    context : str
        In which the sayings are translated.
    sayings : collection of str
        Whole ones, marked, with what changes in them as ``{fields}``; those are said likewise.
    others : callable, optional
        Says what is none of them; by default that stays as it is.
    """
    fixed = frozenset(saying for saying in sayings if "{" not in saying)
    patterns = tuple(
        (re.compile(_FIELD.sub(r"(?P<\1>.+)", re.escape(saying)), re.DOTALL), saying)
        for saying in sayings
        if saying not in fixed
    )

    def say(text: str) -> str:
        if text in fixed:
            return translate(context, text)
        for pattern, saying in patterns:
            found = pattern.fullmatch(text)
            if found is not None:
                fields = {name: say(value) for name, value in found.groupdict().items()}
                return translate(context, saying).format(**fields)
        return others(text)

    return say


# Says the sayings above; what is not known here is unchanged.
spoken = speaker("shell", SAYINGS)
