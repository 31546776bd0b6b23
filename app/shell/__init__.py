"""The main window (Qt), which hosts the panels.

``window`` is the window itself; ``panels``, ``notices``, ``records``, ``help`` and ``support`` are
its parts. ``startup`` opens it. Panels use ``rotemina.app.workbench`` instead, and of this folder
only the dialogs in ``records``.
"""
