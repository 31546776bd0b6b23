"""The panels of the operator's window, one folder each.

The program finds each panel by its entry point, as it does with panels of other packages. ``panel``
of each folder has the panel; the other modules are its parts. Panels may use a few parts of each
other, which their folders export. Nothing below this layer imports from here.
"""
