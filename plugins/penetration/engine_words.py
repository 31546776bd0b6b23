"""Words of the engine that the panel shows: phases, verdicts, parameters, by one table."""

from rotemina.app.shell.language import marked, translate

_WORDS = {
    # phases
    marked("penetration", "disarmed"),
    marked("penetration", "armed"),
    marked("penetration", "approach"),
    marked("penetration", "contact"),
    marked("penetration", "thrust"),
    marked("penetration", "hold"),
    marked("penetration", "inject"),
    marked("penetration", "hold after"),
    marked("penetration", "retract"),
    # verdicts
    marked("penetration", "done"),
    marked("penetration", "aborted"),
    marked("penetration", "failed"),
    marked("penetration", "held"),
    # parameters that are no numbers, and what they can be
    marked("penetration", "axis"),
    marked("penetration", "direction"),
    marked("penetration", "shape"),
    marked("penetration", "shaping"),
    marked("penetration", "table"),
    marked("penetration", "down"),
    marked("penetration", "up"),
    # how a phase of the strip is lit
    marked("penetration", "off"),
    marked("penetration", "passed"),
    marked("penetration", "present"),
}


def spoken(word: str) -> str:
    """Return a word of the engine in the language in use, itself where it is not known."""
    return translate("penetration", word) if word in _WORDS else word
