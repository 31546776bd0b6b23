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


def test_only_offered_buttons_are_in_the_palette(window, add_button):
    add_button("Dispense")
    assert "Faults: Dispense" not in [entry.text for entry in window._make_palette_entries()]


def test_a_panel_ranks_before_a_button_that_matches_better(window, add_button):
    offer_in_palette(add_button("Faults"), add_button("Faults by date"))
    palette = window.palette_page
    window.toggle_palette()
    for query in ("faults", "fau", "fts"):
        palette.field.setText(query)
        assert palette._shown[0].text == "Panel: Faults"
    palette.field.setText("faults date")
    assert palette._shown[0].text == "Faults: Faults by date"
    window.toggle_palette()


@pytest.mark.parametrize("hide", ["closed", "behind another"])
def test_a_hidden_panel_is_opened_and_its_button_not_clicked(qtbot, window, add_button, hide):
    dispense = add_button("Dispense")
    offer_in_palette(dispense)
    window.bring_up("faults")
    if hide == "closed":
        window.docks["faults"].close()
    else:
        window.bring_up("trajectory")  # its dock is in the same area
    qtbot.waitUntil(lambda: window.panels["faults"].visibleRegion().isEmpty(), timeout=LONG_MS)
    palette = window.palette_page
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


def test_a_safe_button_runs_while_its_panel_is_hidden(window, add_button):
    halt = add_button("Stop pump")
    offer_in_palette(halt, safe_while_hidden=True)
    window.docks["faults"].close()
    find_entry(window, "Faults: Stop pump").run()
    assert halt.clicks == ["Stop pump"]


def test_no_motion_command_runs_while_its_panel_is_hidden(qtbot, window, monkeypatch):
    bench, calls = window.workbench, []
    safe = {"Stop", "Stop and lock", "Connect …"}
    actions = (
        "toggle_playback",
        "release",
        "undo",
        "home",
        "clear_fault",
        "reconnect",
        "disconnect_device",
    )
    for name in actions:
        monkeypatch.setattr(bench, name, lambda name=name: calls.append(name))
    motion_entries = [
        entry
        for entry in window._make_palette_entries()
        if entry.group == "Motion" and entry.title not in safe
    ]
    assert len(motion_entries) == len(actions)
    for entry in motion_entries:
        for dock in window.docks.values():
            dock.close()
        entry.run()
    assert calls == []


def test_stops_work_while_every_panel_is_hidden(window):
    for dock in window.docks.values():
        dock.close()
    session = window.workbench.session
    before = session.snapshot().stop
    find_entry(window, "Motion: Stop").run()
    assert session.snapshot().stop is not before
    find_entry(window, "Motion: Stop and lock").run()
    assert session.snapshot().latch_reason is not None


def test_a_command_whose_panel_is_missing_refers_to_the_menu(window):
    window.panels.make_all()
    for panels in (window.panels.panel_types, window.panels.made):
        panels.pop("connection")
    assert find_entry(window, "Motion: Reconnect").objection == "its panel is missing; use the menu"
