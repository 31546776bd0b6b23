"""Measurements in images.

Registration, calibration, focus, drift, the tip and the cell.

Pixels are (column, row), counted from the centre of the upper left one. Whatever is measured in an
image comes with its uncertainty, or is refused with the reason.
"""
