"""Teleoperation panel: control, mode, scale, and an on-screen pad."""

from rotemina.app.shell.language import texts_of

tr, mark = texts_of("teleoperation")
