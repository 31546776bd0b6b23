"""The command ``rotemina``.

``main`` chooses the subcommand, and ``window`` opens the operator's window. The subcommands are in
folders by subject, one module each; ``terminal`` holds what they share. Nothing imports from here.
"""
