"""Buttons of panels are right before the first frame, and say why they cannot be pressed."""

from importlib.metadata import entry_points

import pytest
from PySide6.QtWidgets import QAbstractButton, QAbstractScrollArea, QTabBar

from rotemina.app.motion.session import MotionSession
from rotemina.app.plugin_kit.panel_bench import panel_bench
from rotemina.app.plugin_kit.panel_check import enabled_at_once
from rotemina.app.widgets.controls import why_not

PANELS = {point.name: point for point in entry_points(group="rotemina.panels")}


@pytest.mark.usefixtures("qapp")
@pytest.mark.parametrize("name", PANELS)
def test_buttons_are_right_before_the_first_frame(name):
    with panel_bench(PANELS[name].load()) as bench:
        enabled_at_once(bench)


def reason(button, panel):
    """Return why a button is disabled, or the part of the panel that it is in."""
    part = button
    while part is not panel and not why_not(part):
        part = part.parentWidget()
    return None if part is panel else why_not(part)


@pytest.mark.usefixtures("qapp")
@pytest.mark.parametrize("name", PANELS)
def test_every_button_that_is_disabled_says_why(name):
    with panel_bench(PANELS[name].load()) as bench:
        for change in (lambda _: None, MotionSession.emergency_stop, MotionSession.disconnect):
            bench.change_unseen(change)
            bench.refresh()
            silent = [
                button.text() or button.accessibleName()
                for button in bench.panel.findChildren(QAbstractButton)
                # Arrows that scroll tabs, and corners of tables, are Qt's own.
                if not isinstance(button.parentWidget(), QTabBar | QAbstractScrollArea)
                and not button.isEnabled()
                and not reason(button, bench.panel)
            ]
            assert silent == []
