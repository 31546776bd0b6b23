"""The Control panel: readouts of all axes, and jogs and moves to a position.

Each page of the panel is one module: ``axes_page``, ``positions_page``, ``stick_page`` and others.
It also shows texts and buttons of the panels for connection, penetration and teleoperation.
"""

from rotemina.app.language import make_text_functions

tr, mark = make_text_functions("control")
