"""The command palette opens panels and operates no hidden control."""

import pytest
from PySide6.QtWidgets import QPushButton

from rotemina.app.panel import offer_in_palette

PANELS = ("connection", "faults", "trajectory")
LONG_MS = 30_000


@pytest.fixture
def add_button(window):
    """Return a function that adds a button, which counts its clicks, to the panel *Faults*."""

    def add_to_panel(text):
        new_button = QPushButton(text, window.panels["faults"])
        new_button.clicks = []
        new_button.clicked.connect(lambda: new_button.clicks.append(text))
        new_button.show()
        return new_button

    return add_to_panel


def find_entry(window, text):
    return next(candidate for candidate in window._make_palette_entries() if candidate.text == text)


def test_a_panel_ranks_before_an_offered_button_that_matches_better(window, add_button):
    offer_in_palette(add_button("Faults"), add_button("Faults by date"))
    add_button("Dispense")
    assert "Faults: Dispense" not in [entry.text for entry in window._make_palette_entries()]
    palette = window.palette_page
    window.toggle_palette()
    for query in ("faults", "fau", "fts"):
        palette.field.setText(query)
        assert palette._shown[0].text == "Panel: Faults"
    palette.field.setText("faults date")
    assert palette._shown[0].text == "Faults: Faults by date"
    window.toggle_palette()


def test_a_hidden_panel_is_opened_and_its_button_not_clicked(qtbot, window, add_button):
    dispense, palette = add_button("Dispense"), window.palette_page
    offer_in_palette(dispense)
    for hide in (window.docks["faults"].close, lambda: window.bring_up("trajectory")):
        window.bring_up("faults")
        qtbot.waitUntil(lambda: not dispense.visibleRegion().isEmpty(), timeout=LONG_MS)
        dispense.clicks.clear()
        hide()  # the dock of the trajectory is in the same area
        qtbot.waitUntil(lambda: dispense.visibleRegion().isEmpty(), timeout=LONG_MS)
        window.toggle_palette()
        palette.field.setText("dispense")
        assert "Press Enter to open Faults" in palette.reason.text()
        palette.run_selected()
        assert dispense.clicks == []
        qtbot.waitUntil(lambda: not dispense.visibleRegion().isEmpty(), timeout=LONG_MS)
        assert "Dispense: not run" in window.notices.notices()[0].text
        window.toggle_palette()
        palette.field.setText("dispense")
        assert palette.reason.text() == "Press Enter to run it."
        palette.run_selected()
        assert dispense.clicks == ["Dispense"]


def test_only_stops_and_safe_buttons_run_while_their_panel_is_hidden(
    window, add_button, monkeypatch
):
    bench, calls = window.workbench, []
    halt = add_button("Stop pump")
    offer_in_palette(halt, safe_while_hidden=True)
    actions = (
        *("toggle_playback", "release", "undo", "home", "clear_fault", "reconnect"),
        "disconnect_device",
    )
    for name in actions:
        monkeypatch.setattr(bench, name, lambda name=name: calls.append(name))
    motion_entries = [
        entry
        for entry in window._make_palette_entries()
        if entry.group == "Motion" and entry.title not in {"Stop", "Stop and lock", "Connect …"}
    ]
    assert len(motion_entries) == len(actions)
    for entry in motion_entries:
        close_docks(window)
        entry.run()
    assert calls == []
    close_docks(window)
    find_entry(window, "Faults: Stop pump").run()
    assert halt.clicks == ["Stop pump"]
    before = bench.session.snapshot().stop
    find_entry(window, "Motion: Stop").run()
    assert bench.session.snapshot().stop is not before
    find_entry(window, "Motion: Stop and lock").run()
    assert bench.session.snapshot().latch_reason is not None
    window.panels.make_all()
    for panels in (window.panels.panel_types, window.panels.made):
        panels.pop("connection")
    assert find_entry(window, "Motion: Reconnect").objection == "its panel is missing; use the menu"


def close_docks(window):
    for dock in window.docks.values():
        dock.close()
