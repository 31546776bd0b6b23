from .qt_setup import (
    OFFSCREEN_PREFIX as OFFSCREEN_PREFIX,
)
from .window_start import (
    start as start,
)
