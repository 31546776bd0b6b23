"""Settings of the C library's memory allocator, so that large free blocks return to the system.

By default the allocator opens an arena for every few threads. After the first large array is freed,
it also keeps ever larger blocks in the arenas. After hours of playing, the free memory is
fragmented and cannot be used again.
"""

import ctypes
import sys
from collections.abc import Callable

_MAX_ARENAS = 2
# Larger blocks are mapped separately and returned when they are freed.
_MIN_MAPPED_BYTES = 1 << 20
# Parameter numbers from malloc.h of the GNU C library.
_TRIM_THRESHOLD, _MMAP_THRESHOLD, _ARENA_MAX = -1, -3, -8


def configure_allocator() -> bool:
    """Set up the C library's allocator; return whether it accepted all settings.

    Call this before any thread is started.
    """
    mallopt = _find_c_function("mallopt")
    if mallopt is None:
        return False
    settings = (
        (_ARENA_MAX, _MAX_ARENAS),
        (_MMAP_THRESHOLD, _MIN_MAPPED_BYTES),
        (_TRIM_THRESHOLD, _MIN_MAPPED_BYTES),
    )
    results = [mallopt(parameter, value) == 1 for parameter, value in settings]
    return all(results)


def release_free_memory() -> bool:
    """Return free memory between used blocks to the system; return whether that is supported.

    The call takes a few milliseconds. Make it now and then.
    """
    trim = _find_c_function("malloc_trim")
    return trim is not None and trim(0) == 1


def _find_c_function(name: str) -> Callable[..., int] | None:
    """Return a function of the GNU C library, or None if another library is in use."""
    if not sys.platform.startswith("linux"):
        return None
    try:
        return getattr(ctypes.CDLL(None), name)
    except (AttributeError, OSError):
        return None
