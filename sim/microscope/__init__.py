"""The simulated microscope.

What a camera sees of the tip, the pin and a cell.
"""
