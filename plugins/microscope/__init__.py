"""Panel with the microscope picture, and moves of the tip by a click in the picture.

``picture_view`` shows the picture, the modules ``…_section`` are the tools next to it, and
``geometry`` maps pixels to the screen. The services behind it are in ``app/microscope``.
"""

from rotemina.app.language import make_text_functions

tr, mark = make_text_functions("microscope")
