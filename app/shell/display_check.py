"""Whether there is a display to open a window on."""

import ctypes
import os
import sys

from rotemina.app.system_check import platform_in_use


def display_fault() -> str | None:
    """Return why no window can be shown, or None where one can.

    Qt aborts the program when it cannot reach the display that it was told of, so the X server
    is asked first.
    """
    if not sys.platform.startswith("linux"):
        return None
    platform = platform_in_use(os.environ)
    if platform == "offscreen":
        asked = os.environ.get("QT_QPA_PLATFORM")
        return f"QT_QPA_PLATFORM={asked}" if asked else "no DISPLAY or WAYLAND_DISPLAY is set"
    if platform == "xcb" and not _x_server_answers():
        return f"the display {os.environ.get('DISPLAY', '')!r} does not answer"
    return None


def _x_server_answers() -> bool:
    try:
        xcb = ctypes.CDLL("libxcb.so.1")
    except OSError:
        return True  # its absence is reported with the other missing libraries
    xcb.xcb_connect.restype = ctypes.c_void_p
    xcb.xcb_connection_has_error.argtypes = (ctypes.c_void_p,)
    xcb.xcb_disconnect.argtypes = (ctypes.c_void_p,)
    connection = xcb.xcb_connect(None, None)
    failed = xcb.xcb_connection_has_error(connection)
    xcb.xcb_disconnect(connection)
    return not failed
