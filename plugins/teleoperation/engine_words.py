"""What the engine says of steering: why nothing moves, why a device is not trusted."""

from rotemina.app.shell import engine_words
from rotemina.app.shell.language import marked

SAYINGS = (
    marked("teleoperation", "{reason}: let go of it first"),
    # factors that a key or a button holds
    marked("teleoperation", "fine"),
    marked("teleoperation", "coarse"),
    # why nothing moves, or more slowly
    marked("teleoperation", "the machine is being stopped"),
    marked("teleoperation", "the machine is {activity}"),
    marked("teleoperation", "playing"),
    marked("teleoperation", "homing"),
    marked("teleoperation", "no stick is trusted: let go of it; hold its dead-man, if it has one"),
    marked("teleoperation", "slowed: the tip is close to its bounds"),
    # why a device or an axis is not trusted
    marked("teleoperation", "not yet seen at rest: let go of it"),
    marked("teleoperation", "has said nothing yet: move it, and let go of it"),
    marked("teleoperation", "jitters from end to end: its potentiometer or cable is bad"),
    marked(
        "teleoperation",
        "has stood at its end from the first moment: free it; if it rests there, calibrate it as "
        "one-sided",
    ),
    marked(
        "teleoperation",
        "silent, though it streams: nothing has come from it; replug it, or look at its cable",
    ),
    marked("teleoperation", "the trainer has taken over"),
    marked("teleoperation", "the trainee has taken over"),
    marked(
        "teleoperation",
        "the trainer's device is not there: the trainee does not drive alone",
    ),
    marked("teleoperation", "no profile is chosen: the input devices do nothing"),
    marked("teleoperation", "axes are moved by {owner}"),
    marked("teleoperation", "driver {driver} cannot move at a speed"),
    marked("teleoperation", "axis {axis} does not follow the stick"),
    marked("teleoperation", "says {raw}, which is not in −1 to 1: disconnect it and look at it"),
    marked("teleoperation", "another device is gone ({why}): let go of it"),
    marked("teleoperation", "calibrated anew"),
    marked(
        "teleoperation",
        "profile {name} is for {gone}, not plugged in; plugged in: {present}. Plug it in, or "
        "choose or make a profile for what is there",
    ),
)
#: Says them in the language in use, and what the window knows of besides.
spoken = engine_words.speaker("teleoperation", SAYINGS, engine_words.spoken)
