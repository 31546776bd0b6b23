"""Templates and checks of third-party plugins.

Plugins that fail are left out.
"""
