"""Files that the program carries.

Robots, trajectories, published models, templates, languages, theme and icons.
"""
