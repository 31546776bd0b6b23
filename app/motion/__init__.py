"""The motion of a machine: everything between an operator's request and a driver. No Qt.

``session`` is the interface to a machine. It checks requests against ``limits`` and passes them to
``device``, whose worker is the only thread that talks to a driver. ``state`` describes the result,
and ``model`` runs along. ``playback``, ``recording``, ``inputs``, ``teleoperation`` and
``penetration`` build on the session.
"""
