"""The program: motion session, command line and the window that hosts the panels."""
