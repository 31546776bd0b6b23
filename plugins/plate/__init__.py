"""Panel with the holding plate in 3-D: stress, deformation and modes.

``background_solution`` solves a plate, and ``rasteriser`` draws it without OpenGL. The finite
elements are in ``sim/plate``.
"""

from rotemina.app.language import make_text_functions

tr, mark = make_text_functions("plate")
