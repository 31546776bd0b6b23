"""A check for a display on which a window can be opened."""

import ctypes
import os
import sys

from rotemina.app.system import find_platform


def find_display_fault() -> str | None:
    """Return why no window can be shown, or None if one can.

    Qt aborts the program if it cannot reach the configured display, so the X server is contacted
    first.
    """
    if not sys.platform.startswith("linux"):
        return None
    platform = find_platform(os.environ)
    if platform == "offscreen":
        platform_setting = os.environ.get("QT_QPA_PLATFORM")
        return (
            f"QT_QPA_PLATFORM={platform_setting}"
            if platform_setting
            else "no DISPLAY or WAYLAND_DISPLAY is set"
        )
    if platform == "xcb" and not _is_x_server_answering():
        return f"the display {os.environ.get('DISPLAY', '')!r} does not answer"
    return None


def _is_x_server_answering() -> bool:
    try:
        xcb = ctypes.CDLL("libxcb.so.1")
    except OSError:
        # The system check reports missing libraries, all of them together.
        return True
    xcb.xcb_connect.restype = ctypes.c_void_p
    xcb.xcb_connection_has_error.argtypes = (ctypes.c_void_p,)
    xcb.xcb_disconnect.argtypes = (ctypes.c_void_p,)
    connection = xcb.xcb_connect(None, None)
    error_code = xcb.xcb_connection_has_error(connection)
    xcb.xcb_disconnect(connection)
    return error_code == 0
