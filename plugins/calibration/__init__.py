"""Sensor calibration panel."""

from rotemina.app.shell.language import texts_of

tr, mark = texts_of("calibration")
