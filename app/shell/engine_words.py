"""What the engine says, in the language of the window.

Sentences come as messages, which know their template and their fields; single words, as a phase or
the state of a camera, are among :data:`WORDS`. What is neither, as the text of a plugin or of the
operating system, is shown as it is.
"""

from rotemina.app.shell.language import TranslatedWording as TranslatedWording
from rotemina.app.shell.language import WindowWording as WindowWording
from rotemina.app.shell.language import error_text as error_text
from rotemina.app.shell.language import marked
from rotemina.app.shell.language import spoken as spoken

# Words of enumerations, which are shown alone or stand in a sentence's fields.
WORDS = (
    # quantities that a limit is for
    marked("engine", "position"),
    marked("engine", "voltage"),
    marked("engine", "speed"),
    marked("engine", "acceleration"),
    marked("engine", "predicted motion"),
    # what the machine must be at rest for
    marked("engine", "closing a loop"),
    marked("engine", "opening a loop"),
    marked("engine", "applying an inverse"),
    marked("engine", "removing an inverse"),
    marked("engine", "teaching the floor"),
    marked("engine", "removing the floor"),
    marked("engine", "reserving the axes"),
    marked("engine", "changing the approach of an axis"),
    marked("engine", "narrowing a range"),
    marked("engine", "restoring a range"),
    marked("engine", "a profile"),
    marked("engine", "setting a voltage"),
    # what a driver cannot do now
    marked("engine", "accept its parameters"),
    marked("engine", "capture"),
    marked("engine", "change a compensation"),
    marked("engine", "change a loop"),
    marked("engine", "change its effects"),
    marked("engine", "clear a fault"),
    marked("engine", "home"),
    marked("engine", "play"),
    marked("engine", "set a voltage"),
    marked("engine", "read"),
    marked("engine", "run a profile"),
    marked("engine", "show text"),
    marked("engine", "switch the tool off"),
    marked("engine", "switch the tool on"),
    marked("engine", "accept a profile"),
    marked("engine", "write its parameters"),
    marked("engine", "resume"),
    marked("engine", "step through"),
    marked("engine", "start over"),
    # who drives
    marked("engine", "operator"),
    marked("engine", "playback"),
    marked("engine", "homing"),
    marked("engine", "joystick"),
    marked("engine", "penetration"),
    # how a camera does, and what the microscope is about
    marked("engine", "closed"),
    marked("engine", "opening"),
    marked("engine", "live"),
    marked("engine", "stalled"),
    marked("engine", "frozen"),
    marked("engine", "black"),
    marked("engine", "lost"),
    marked("engine", "calibration"),
    marked("engine", "click"),
    marked("engine", "visit of a target"),
    marked("engine", "autofocus"),
    marked("engine", "z-stack"),
    # the tip in the picture, and visits of places
    marked("engine", "off"),
    marked("engine", "searched"),
    marked("engine", "tracked"),
    marked("engine", "under way"),
    marked("engine", "arrived"),
    marked("engine", "failed"),
    # stages, pixels, triggers, colours
    marked("engine", "micro"),
    marked("engine", "nano"),
    marked("engine", "mono8"),
    marked("engine", "mono16"),
    marked("engine", "colour"),
    marked("engine", "free-running"),
    marked("engine", "software"),
    marked("engine", "grey"),
    marked("engine", "grey, inverted"),
    marked("engine", "viridis"),
    marked("engine", "grey, saturated red"),
    # what lies over the picture, and what a click does
    marked("engine", "crosshair"),
    marked("engine", "tip"),
    marked("engine", "targets"),
    marked("engine", "path"),
    marked("engine", "range of the nano stage"),
    marked("engine", "cell"),
    marked("engine", "measure"),
    marked("engine", "pan"),
    marked("engine", "move"),
    marked("engine", "mark"),
    # phases of a penetration, and how a run ended
    marked("engine", "disarmed"),
    marked("engine", "armed"),
    marked("engine", "approach"),
    marked("engine", "contact"),
    marked("engine", "thrust"),
    marked("engine", "hold"),
    marked("engine", "inject"),
    marked("engine", "hold after"),
    marked("engine", "retract"),
    marked("engine", "aborted"),
    marked("engine", "held"),
    marked("engine", "no contact"),
    # its parameters that are no numbers, and how a phase is lit
    marked("engine", "axis"),
    marked("engine", "direction"),
    marked("engine", "shape"),
    marked("engine", "shaping"),
    marked("engine", "table"),
    marked("engine", "down"),
    marked("engine", "up"),
    marked("engine", "passed"),
    marked("engine", "present"),
    # steering
    marked("engine", "fine"),
    marked("engine", "coarse"),
    marked("engine", "playing"),
    marked("engine", "Automatic"),
    marked("engine", "move the axis now"),
    # what the operating system says of files
    marked("engine", "Permission denied"),
    marked("engine", "No such file or directory"),
    marked("engine", "File exists"),
    marked("engine", "Is a directory"),
    marked("engine", "Not a directory"),
    marked("engine", "No space left on device"),
    marked("engine", "Read-only file system"),
    marked("engine", "Input/output error"),
    # what the nano stage is moved for
    marked("engine", "Re-centring"),
    marked("engine", "Preparing"),
)
