"""What the engine says of axes, devices and profiles, for the window's language."""

from rotemina.app.shell import engine_words
from rotemina.app.shell.language import marked

SAYINGS = (
    marked("inputs", "{reason}: let go of it first"),
    marked("inputs", "the trainer's device is not there: the trainee does not drive alone"),
    marked("inputs", "the trainee has taken over"),
    marked("inputs", "the trainer has taken over"),
    marked("inputs", "not yet seen at rest: let go of it"),
    marked("inputs", "has said nothing yet: move it, and let go of it"),
    marked("inputs", "jitters from end to end: its potentiometer or cable is bad"),
    marked(
        "inputs",
        "has stood at its end from the first moment: free it; if it rests there, calibrate "
        "it as one-sided",
    ),
    marked(
        "inputs",
        "silent, though it streams: nothing has come from it; replug it, or look at its cable",
    ),
    marked("inputs", "no profile is chosen: the input devices do nothing"),
    marked("inputs", "Automatic"),
    marked("inputs", "move the axis now"),
    marked("inputs", "says {raw}, which is not in −1 to 1: disconnect it and look at it"),
    marked("inputs", "another device is gone ({why}): let go of it"),
    marked("inputs", "calibrated anew"),
    marked(
        "inputs",
        "a reading of {axes} axes and {buttons} buttons came from a device with {known} and "
        "{others}: replug it",
    ),
    marked("inputs", "{names} moved together; move one only"),
    marked(
        "inputs",
        "profile {name} is for {gone}, not plugged in; plugged in: {present}. Plug it in, or "
        "choose or make a profile for what is there",
    ),
    # of an axis that is being calibrated
    marked("inputs", "axis {axis} has said nothing at rest; move it once, let go, and begin again"),
    marked(
        "inputs",
        "axis {axis} hardly moved: {low} to {high} of −1 to 1, at least {least} is needed; "
        "move it to all its ends",
    ),
    marked("inputs", "axis {axis} does not rest at an end: {where}; calibrate it as a stick"),
    marked(
        "inputs",
        "axis {axis} rests at an end: {where}; move it both ways, or declare it one-sided (a "
        "trigger)",
    ),
    marked("inputs", "rest {centre}, ends {low} and {high}"),
    marked(
        "inputs",
        "axis {axis} jitters at rest, or was moved: {low} to {high} asks for a dead zone of "
        "{zone}, at most {most} is good; leave it alone, and if it stays so have it repaired",
    ),
)
#: Says them in the language in use, and what the window knows of besides.
spoken = engine_words.speaker("inputs", SAYINGS, engine_words.spoken)
