"""Data files that are shipped with the program.

Robots, trajectories, published models, templates, languages, theme and icons.
"""
