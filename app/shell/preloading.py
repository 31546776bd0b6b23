"""What panels and views need at their first use, loaded before that, away from the window."""

import gc
import importlib
import logging
import threading
from collections.abc import Iterable

from rotemina.app.motion.recording.arrow_tables import prepare
from rotemina.drivers.registry import discover_drivers
from rotemina.sim.effects.registry import all_effects

logger = logging.getLogger(__name__)

#: Each takes tenths of a second to load, for which whoever first chose its view would wait.
LATE = ("scipy.optimize", "scipy.interpolate", "scipy.signal", "polars", "tifffile")


def preload(names: Iterable[str]) -> threading.Thread:
    """Begin to load modules on a thread of their own, which is returned.

    One that cannot be loaded is left to whoever needs it, and says so then.
    """

    def load() -> None:
        for name in names:
            try:
                importlib.import_module(name)
            except Exception as error:  # a broken library breaks at import as it likes
                logger.info("%s cannot be loaded before it is needed: %s", name, error)
        discover_drivers()  # which panels offer to choose from
        all_effects()
        prepare()  # a recording begins at once from then on
        gc.freeze()  # what was loaded stays: no look for garbage need go through it

    thread = threading.Thread(target=load, name="preloading", daemon=True)
    thread.start()
    return thread
