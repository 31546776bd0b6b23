"""How the C library hands out memory: so that what was large and is free goes back to the system.

Left to itself it opens an arena for every few threads and, after the first large array was freed,
keeps ever larger ones in them. Hours of plays then leave gaps that nothing fits into.
"""

import ctypes
import sys
from collections.abc import Callable

_ARENAS = 2
_LARGE_BYTES = 1 << 20  # what is larger is mapped by itself, and given back when it is freed
# malloc.h of the GNU C library
_TRIM_THRESHOLD, _MMAP_THRESHOLD, _ARENA_MAX = -1, -3, -8


def trim_heap() -> bool:
    """Ask the C library for it, before there are threads; return whether it can do that."""
    mallopt = _of_the_library("mallopt")
    if mallopt is None:
        return False
    asked = (
        (_ARENA_MAX, _ARENAS),
        (_MMAP_THRESHOLD, _LARGE_BYTES),
        (_TRIM_THRESHOLD, _LARGE_BYTES),
    )
    done = [mallopt(what, value) == 1 for what, value in asked]
    return all(done)


def give_back() -> bool:
    """Give back what is free between pieces in use; return whether the C library can do that.

    It takes a few milliseconds, and is worth a call now and then.
    """
    trim = _of_the_library("malloc_trim")
    return trim is not None and trim(0) == 1


def _of_the_library(name: str) -> Callable[..., int] | None:
    """Return a function of the GNU C library; None where there is another one."""
    if not sys.platform.startswith("linux"):
        return None
    try:
        return getattr(ctypes.CDLL(None), name)
    except (AttributeError, OSError):
        return None
