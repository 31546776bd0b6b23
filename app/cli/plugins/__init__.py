"""Subcommands for authors of plugins: drivers, effects, and packages of plugins.

Each module is one subcommand. The templates and checks are in ``app/plugin_kit``,
``drivers/conformance`` and ``sim/simulation``. Only ``app/cli`` imports from here.
"""
