"""Motion session, playback, live data.

The session owns a driver. Free of Qt.
"""
