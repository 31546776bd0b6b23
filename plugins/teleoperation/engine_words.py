"""What the engine says of steering, where it has no values in it, by one table."""

from rotemina.app.shell.language import marked, translate

_WORDS = {
    # factors that a key or a button holds
    marked("teleoperation", "fine"),
    marked("teleoperation", "coarse"),
    # why nothing moves, or more slowly
    marked("teleoperation", "the machine is being stopped"),
    marked("teleoperation", "the machine is playing"),
    marked("teleoperation", "the machine is homing"),
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
    marked("teleoperation", "the trainer has taken over: let go of it first"),
    marked("teleoperation", "the trainee has taken over: let go of it first"),
    marked(
        "teleoperation",
        "the trainer's device is not there: the trainee does not drive alone",
    ),
    marked(
        "teleoperation",
        "the trainer's device is not there: the trainee does not drive alone: let go of it first",
    ),
    marked("teleoperation", "no profile is chosen: the input devices do nothing"),
}


def spoken(said: str) -> str:
    """Return what the engine says in the language in use, itself where it is not known."""
    return translate("teleoperation", said) if said in _WORDS else said
