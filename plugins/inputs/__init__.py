"""The Input devices panel: connected devices, their readings, mapping and calibration.

Each section of the panel is one module. ``profiles`` and ``profile_edits`` change mappings without
widgets. What the mappings do is in ``app/motion/inputs``.
"""

from rotemina.app.language import make_text_functions

tr, mark = make_text_functions("inputs")
