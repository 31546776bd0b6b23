"""The application: motion session, command line, and the window with its panels.

``motion`` moves the machine, ``shell`` is the window, and ``cli`` the command line. Panels stand on
``panel``, ``workbench``, ``widgets`` and ``language``. Only plugins may import from this layer.
"""

from rotemina.sim.compatibility import serve_former_modules

serve_former_modules()
