"""The buttons of a floating panel still call the main window."""

import pytest

PANELS = ("comparison",)


@pytest.mark.parametrize(
    ("panel", "button", "method"),
    [
        ("trajectory", "load", "ask_trajectory"),
        ("comparison", "open", "ask_record"),
        ("comparison", "save", "ask_save"),
    ],
)
def test_buttons_of_a_floating_panel_call_the_window(window, monkeypatch, panel, button, method):
    calls = []
    monkeypatch.setattr(window, method, lambda *_, **__: calls.append(method))
    window.docks[panel].setFloating(True)
    pressed_button = getattr(window.panels[panel], button)
    pressed_button.setEnabled(True)
    pressed_button.click()
    assert calls == [method]
