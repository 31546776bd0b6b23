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
    # cameras
    marked("microscope", "pymmcore-plus is not installed: {install}"),
    marked("microscope", "pip install 'rotemina[micromanager]', then mmcore install"),
    marked(
        "microscope",
        "{camera} ({key}), the camera used last, is not there; plug it in, or choose another",
    ),
    # what is seen, or not
    marked(
        "microscope",
        "calibration: {n} moves, must be at least {least}; allow more of them",
    ),
    marked(
        "microscope",
        "calibration: {bad} of {n} moves do not fit, must be at most {most} %; something "
        "else moved, or the tracking slipped: look at the picture and begin again",
    ),
    marked(
        "microscope",
        "calibration: the moves do not span the plane: across their main direction they "
        "reach {part} % of the way along it, must be at least {least} %; move both axes",
    ),
    marked(
        "microscope",
        "calibration: residuals of {rms} px rms (greatest at move {worst}), must be at most "
        "{most} px; backlash, drift or a loose tool: let the stage settle, home it, and "
        "begin again",
    ),
    marked(
        "microscope",
        "calibration: both axes move the picture in nearly the same direction ({angle}° "
        "apart, must be at least {least}°); one of them does not move, or moves along the "
        "view",
    ),
    marked(
        "microscope",
        "calibration: the pixel size is known within {known} %, must be {asked} %; make "
        "larger moves, or more of them",
    ),
    marked(
        "microscope",
        "cell: the line about {column}, {row} px takes {darker} % of the light, must be at "
        "least {least} %; focus on the membrane, or point into the cell",
    ),
    marked(
        "microscope",
        "cell: its outline is {rms} px rms off an ellipse, must be at most {most} % of its "
        "radius; point into the middle of one cell",
    ),
    marked(
        "microscope",
        "drift: {most} of {count} parts of the picture agree on a shift, must be at least "
        "{least} and half of the {seen} that show enough; bring a background with detail "
        "into view and focus",
    ),
    marked(
        "microscope",
        "focus: every look is as sharp as the others; bring detail into view",
    ),
    marked(
        "microscope",
        "focus: no peak of the sharpness stands out; bring detail into view, give more "
        "light, or search a larger range",
    ),
    marked(
        "microscope",
        "focus: it would be sharpest at {place} µm, outside the searched {low} to {high} µm; "
        "search there",
    ),
    marked(
        "microscope",
        "tip: nothing looks like it (greatest likeness {likeness}); bring the tip into view "
        "and near focus, or correct its direction in the image",
    ),
    marked(
        "microscope",
        "tip: nothing in the picture looks like a pipette, in whatever direction; bring the "
        "tip into view and near focus",
    ),
    marked(
        "microscope",
        "nothing like it where it should be",
    ),
    marked(
        "microscope",
        "only {part} % of its surroundings look as they should",
    ),
    marked(
        "microscope",
        "its place is uncertain by {doubt} px",
    ),
    marked(
        "microscope",
        "what is there takes {part} % of the light",
    ),
    marked(
        "microscope",
        "its contrast is {part} % of what it was",
    ),
    marked(
        "microscope",
        "registration: the picture moved by {right}, {down} px and hardly overlaps the one "
        "before; make the move smaller",
    ),
)
#: Says them in the language in use, and what the window knows of besides.
spoken = engine_words.speaker("microscope", SAYINGS, engine_words.spoken)
