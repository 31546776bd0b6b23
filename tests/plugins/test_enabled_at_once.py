"""Buttons are enabled correctly before the first frame, and disabled ones have a reason."""

from importlib.metadata import entry_points

import pytest
from PySide6.QtWidgets import QAbstractButton, QAbstractScrollArea, QTabBar

from rotemina.app.motion.session import MotionSession
from rotemina.app.plugin_kit import open_panel_bench
from rotemina.app.plugin_kit.panel_check import enabled_at_once
from rotemina.app.widgets.controls import get_disabled_reason

PANELS = {point.name: point for point in entry_points(group="rotemina.panels")}


@pytest.mark.usefixtures("qapp")
@pytest.mark.parametrize("name", PANELS)
def test_buttons_are_enabled_correctly_before_the_first_frame(name):
    with open_panel_bench(PANELS[name].load()) as bench:
        enabled_at_once(bench)


def find_reason(button, panel):
    """Return the reason why a button or a part of the panel around it is disabled."""
    part = button
    while part is not panel and not get_disabled_reason(part):
        part = part.parentWidget()
    return None if part is panel else get_disabled_reason(part)


@pytest.mark.usefixtures("qapp")
@pytest.mark.parametrize("name", PANELS)
def test_every_disabled_button_has_a_reason(name):
    with open_panel_bench(PANELS[name].load()) as bench:
        for change in (lambda _: None, MotionSession.emergency_stop, MotionSession.disconnect):
            bench.change_without_update(change)
            bench.refresh()
            without_reason = [
                button.text() or button.accessibleName()
                for button in bench.panel.findChildren(QAbstractButton)
                # Qt adds the arrows of tab bars and the corners of tables.
                if not isinstance(button.parentWidget(), QTabBar | QAbstractScrollArea)
                and not button.isEnabled()
                and not find_reason(button, bench.panel)
            ]
            assert without_reason == []
