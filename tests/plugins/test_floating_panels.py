"""The buttons of a floating panel still call the main window."""

PANELS = ("comparison",)


def test_buttons_of_a_floating_panel_call_the_window(window, monkeypatch):
    for panel, button, method in (
        ("trajectory", "load", "ask_trajectory"),
        ("comparison", "open", "ask_record"),
        ("comparison", "save", "ask_save"),
    ):
        calls = []
        monkeypatch.setattr(window, method, lambda *_, calls=calls, **__: calls.append(1))
        window.docks[panel].setFloating(True)
        pressed_button = getattr(window.panels[panel], button)
        pressed_button.setEnabled(True)
        pressed_button.click()
        assert calls == [1], method
