"""A panel whose dock floats by itself still reaches the window."""

import pytest

PANELS = ("comparison",)


@pytest.mark.parametrize(
    ("panel", "button", "asks"),
    [
        ("trajectory", "load", "ask_trajectory"),
        ("comparison", "open", "ask_record"),
        ("comparison", "save", "ask_save"),
    ],
)
def test_buttons_of_a_floating_panel_reach_the_window(window, monkeypatch, panel, button, asks):
    asked = []
    monkeypatch.setattr(window, asks, lambda *_, **__: asked.append(asks))
    window.docks[panel].setFloating(True)
    pressed = getattr(window.panels[panel], button)
    pressed.setEnabled(True)
    pressed.click()
    assert asked == [asks]
