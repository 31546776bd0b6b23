"""Input devices and their set-up.

Connected devices, their readings and their functions.
"""
