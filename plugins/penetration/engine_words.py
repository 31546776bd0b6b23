"""Words and sayings of the engine that the panel shows: phases, verdicts, reasons."""

from rotemina.app.shell import engine_words
from rotemina.app.shell.language import marked

SAYINGS = (
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
    # why it cannot be armed
    marked(
        "penetration",
        "axis {axis}: {left} of its range are left {direction}wards, {needed} are needed "
        "({approach} to approach, {halt} to halt, {thrust} to thrust); move the axis back first, "
        "or shorten them",
    ),
    marked("penetration", "driver {driver} cannot run profiles by itself; a thrust needs that"),
    marked("penetration", "driver {driver} cannot move at a speed; the approach needs that"),
    marked("penetration", "driver {driver} has no tool that could inject; set inject_s to 0"),
    marked("penetration", "axis {axis} of {robot} turns; a penetration needs a way in m"),
    marked("penetration", "approach_speed = {speed}/s: axis {axis} goes at {most}/s at most"),
    marked(
        "penetration",
        "shaping = {shaping}: axis {axis} of {robot} has no resonance in its robot file; choose "
        "'none'",
    ),
    marked(
        "penetration",
        "duration_s = {duration} s: input shaping {shaping} takes {taken} s of it; at least "
        "{least} s, or another shaping",
    ),
    marked("penetration", "a trajectory is playing and owns every axis; stop it first"),
    marked("penetration", "a penetration is {phase}; end it first"),
    # why a run has ended, or is held
    marked("penetration", "nobody started it in time"),
    marked("penetration", "stopped by the button in {phase}"),
    marked("penetration", "the retraction was stopped by the button"),
    marked("penetration", "retracted by the button; before: {reason}"),
    marked("penetration", "the axis has moved since it was armed; arm it again"),
    marked("penetration", "no contact"),
    marked("penetration", "no contact within {distance}; start nearer to the cell"),
    marked("penetration", "the device sends too few samples"),
    marked("penetration", "the axis did not come to rest"),
    marked("penetration", "the axis did not come back"),
    marked("penetration", "the device did not run the thrust"),
    marked("penetration", "too few samples of the thrust"),
    marked("penetration", "the thrust went {depth}: must be {asked} within {tolerance} %"),
    marked("penetration", "overload: the axis is {load} from where it should be, {most} at most"),
    marked("penetration", "a stop was asked for"),
    marked("penetration", "somebody took an axis over"),
)
#: Says them in the language in use, and what the window knows of besides.
spoken = engine_words.speaker("penetration", SAYINGS, engine_words.spoken)
