"""Words of the engine that the panel shows: states, activities, looks, by one table."""

from rotemina.app.shell.language import marked, translate

_WORDS = {
    # how a camera is doing, and what the microscope moves something for
    marked("microscope", "closed"),
    marked("microscope", "opening"),
    marked("microscope", "live"),
    marked("microscope", "waiting for a trigger"),
    marked("microscope", "stalled"),
    marked("microscope", "frozen"),
    marked("microscope", "black"),
    marked("microscope", "lost"),
    marked("microscope", "none"),
    marked("microscope", "calibration"),
    marked("microscope", "click"),
    marked("microscope", "visit of a target"),
    marked("microscope", "autofocus"),
    # tip, and visits of places
    marked("microscope", "off"),
    marked("microscope", "searched"),
    marked("microscope", "tracked"),
    marked("microscope", "under way"),
    marked("microscope", "arrived"),
    marked("microscope", "failed"),
    # what is always there to look through
    marked("microscope", "Simulated microscope"),
    # stages, pixels, triggers, colours
    marked("microscope", "micro"),
    marked("microscope", "nano"),
    marked("microscope", "mono8"),
    marked("microscope", "mono16"),
    marked("microscope", "colour"),
    marked("microscope", "free-running"),
    marked("microscope", "software"),
    marked("microscope", "grey"),
    marked("microscope", "grey, inverted"),
    marked("microscope", "viridis"),
    marked("microscope", "grey, saturated red"),
    # what lies over the picture, and what a click does
    marked("microscope", "crosshair"),
    marked("microscope", "tip"),
    marked("microscope", "targets"),
    marked("microscope", "path"),
    marked("microscope", "range of the nano stage"),
    marked("microscope", "cell"),
    marked("microscope", "measure"),
    marked("microscope", "pan"),
    marked("microscope", "move"),
    marked("microscope", "mark"),
    # reasons without values
    marked("microscope", "the picture is black; check lamp, shutter, lens cap and exposure"),
    marked("microscope", "there is no picture; open a camera and wait for the first one"),
    marked("microscope", "the calibration was stopped"),
    marked("microscope", "it was stopped"),
}


def spoken(word: str) -> str:
    """Return a word of the engine in the language in use, itself where it is not known."""
    return translate("microscope", word) if word in _WORDS else word
