"""Sayings of the engine that the panel shows for long: what a calibration is not, and lacks."""

from rotemina.app.shell import engine_words
from rotemina.app.shell.language import marked

SAYINGS = (
    marked(
        "calibration",
        "{axis}: at runs that were left out of the fit the reading's error is {after} {unit} rms "
        "with the calibration and {before} {same} without; it is not better and not used",
    ),
    marked(
        "calibration",
        "the zero drifts by {drift} rms while the runs last: it goes with time and not with the "
        "axis, and no calibration removes it; warm up, or calibrate often",
    ),
    marked("calibration", "the laser was lost from {begin} s to {end} s"),
    marked("calibration", "no rows from {begin} s to {end} s"),
)
#: Says them in the language in use, and what the window knows of besides.
spoken = engine_words.speaker("calibration", SAYINGS, engine_words.spoken)
