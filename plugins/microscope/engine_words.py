"""Words and sayings of the engine that the panel shows: states, activities, looks, reasons."""

from rotemina.app.shell import engine_words
from rotemina.app.shell.language import marked

SAYINGS = (
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
    # reasons
    marked("microscope", "the picture is black; check lamp, shutter, lens cap and exposure"),
    marked("microscope", "there is no picture; open a camera and wait for the first one"),
    marked("microscope", "the calibration was stopped"),
    marked("microscope", "it was stopped"),
    marked("microscope", "somebody stopped the machine; it stays where it is"),
    marked("microscope", "the camera is {state}: {reason}"),
    marked(
        "microscope",
        "no picture for {seconds} s; check the camera and its cable, or open it again",
    ),
    marked(
        "microscope",
        "every picture has been the same for more than {seconds} s; open it again, and do not "
        "trust what it shows",
    ),
    marked("microscope", "{trouble}; nothing is moved"),
    marked("microscope", "motion is locked: {locked}"),
    marked("microscope", "the machine does not move any more: {reason}"),
    marked("microscope", "it is not connected"),
    marked(
        "microscope",
        "the picture drifted by {drift} px during the calibration, must be at most {most} px; let "
        "stage and camera settle, see to backlash, and begin again",
    ),
    marked("microscope", "{reason}; it could not go back: {error}"),
    marked(
        "microscope",
        "the tip is {distance} px from where it should be, must be at most {most} px after a "
        "move; the calibration does not hold: calibrate anew",
    ),
    marked(
        "microscope",
        "the tip is still {distance} px off after {n} corrections, must be at most {most} px; the "
        "stage resolves no finer, or drifts",
    ),
    marked(
        "microscope",
        "the tip is not seen near {column}, {row} px, where it should be; nothing more is moved: "
        "look at the picture",
    ),
)
#: Says them in the language in use, and what the window knows of besides.
spoken = engine_words.speaker("microscope", SAYINGS, engine_words.spoken)
