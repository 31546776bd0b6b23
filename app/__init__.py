"""The motion session, commands and the window."""
