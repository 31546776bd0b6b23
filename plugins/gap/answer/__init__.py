"""The answer of a diagnosis: views, exports, the switch to the corrected model, unseen motions.

``diagnosis_answer`` has the data that the views draw, and ``result_section`` puts them together.
Each ``…_view`` is one view. Only the Gap panel uses this folder.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
