"""No button of a panel is enabled otherwise before the first frame than after it."""

from importlib.metadata import entry_points

import pytest

from rotemina.app.plugin_kit.panel_bench import panel_bench
from rotemina.app.plugin_kit.panel_check import enabled_at_once

PANELS = {point.name: point for point in entry_points(group="rotemina.panels")}


@pytest.mark.usefixtures("qapp")
@pytest.mark.parametrize("name", PANELS)
def test_buttons_are_right_before_the_first_frame(name):
    with panel_bench(PANELS[name].load()) as bench:
        enabled_at_once(bench)
