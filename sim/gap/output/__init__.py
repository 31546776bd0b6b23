"""Output of a diagnosis: text, JSON, web page, corrected model, prediction.

``summary`` writes text, ``document`` JSON, ``html_page`` the report, and ``digital_twin`` a robot
file with the fitted effects. Nothing here changes a result. The command line, the window and its
Gap panel use it.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
