"""Modules that panels and views need at first use, loaded in advance on another thread."""

import gc
import importlib
import logging
import threading
from collections.abc import Iterable

from rotemina.app.motion.recording import load_arrow
from rotemina.drivers.contract import discover_drivers
from rotemina.sim.effects import load_all_effects

logger = logging.getLogger(__name__)

#: Modules that take tenths of a second to load, which the operator would notice at the first use.
LATE_MODULES = ("scipy.optimize", "scipy.interpolate", "scipy.signal", "pyarrow.csv", "tifffile")


def preload(names: Iterable[str]) -> threading.Thread:
    """Load modules on a new thread; return the thread.

    A module that cannot be loaded is skipped; the code that needs it will report the error.
    """

    def load() -> None:
        for name in names:
            try:
                importlib.import_module(name)
            # A broken library may raise anything at import.
            except Exception as error:
                logger.info("%s cannot be loaded before it is needed: %s", name, error)
        # The panel of the connection lists the drivers.
        discover_drivers()
        load_all_effects()
        # A recording then starts without delay.
        load_arrow()
        # Loaded modules stay, so the garbage collector need not scan them.
        gc.freeze()

    thread = threading.Thread(target=load, name="preloading", daemon=True)
    thread.start()
    return thread
