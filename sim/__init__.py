"""Model of the machine, records, and diagnosis. Everything is in SI units.

Each folder is one subject; it has no threads, no clock and no Qt. ``robot`` describes a machine,
``records`` what it did, ``plant`` and ``effects`` simulate it, and ``gap`` explains where both
differ. Every other layer may import from here.
"""

from rotemina.sim.compatibility import serve_former_modules

serve_former_modules()
