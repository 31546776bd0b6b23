"""The periodic loop that executes all actions of an operator, from joystick to penetration.

``operation`` joins input devices, teleoperation, recording and penetration, each of which can be
used without it. ``front_display`` writes the display at the machine. The workbench starts the loop.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
