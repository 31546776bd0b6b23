"""Panel with the model and the real robot in 3-D.

``canvas`` draws them without a GPU, and ``scene_server`` shows the same scene in browsers. What is
drawn is decided in ``app/scene``.
"""

from rotemina.app.language import make_text_functions

tr, mark = make_text_functions("view3d")
