"""Reading of input files with bounds, and atomic writing of files.

``input_files`` refuses files that are too large or no regular files, and ``whole_files`` writes a
file completely or not at all. Any folder that reads or writes files uses it.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
