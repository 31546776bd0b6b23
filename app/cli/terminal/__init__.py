"""What the subcommands share: options, progress, language, signals, and parallel work.

A subcommand adds its arguments with ``options`` and reports with ``progress``. Its errors are in
``app/errors``. Only the command line may import from here.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
