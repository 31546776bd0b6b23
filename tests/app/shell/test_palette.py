"""The command palette opens panels, and moves nothing that the operator does not see."""

import pytest
from PySide6.QtWidgets import QPushButton

from rotemina.app.panel import offer_in_palette

PANELS = ("connection", "faults", "trajectory")
LONG_MS = 30_000


@pytest.fixture
def button(window):
    """Return how to put a button into the panel *Faults*, which notes its clicks."""

    def add(text):
        made = QPushButton(text, window.panels["faults"])
        made.clicks = []
        made.clicked.connect(lambda: made.clicks.append(text))
        made.show()
        return made

    return add


def entry(window, text):
    return next(each for each in window._entries() if each.text == text)


def test_a_button_that_its_author_does_not_offer_is_not_in_the_palette(window, button):
    button("Dispense")
    assert "Faults: Dispense" not in [each.text for each in window._entries()]


def test_a_panel_comes_before_a_button_that_fits_better(window, button):
    offer_in_palette(button("Faults"), button("Faults by date"))
    palette = window.palette_page
    window.toggle_palette()
    for typed in ("faults", "fau", "fts"):
        palette.field.setText(typed)
        assert palette._shown[0].text == "Panel: Faults"
    palette.field.setText("faults date")
    assert palette._shown[0].text == "Faults: Faults by date"
    window.toggle_palette()


@pytest.mark.parametrize("hide", ["closed", "behind another"])
def test_a_hidden_panel_is_opened_and_its_button_not_clicked(qtbot, window, button, hide):
    dispense = button("Dispense")
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
    palette.do()
    assert dispense.clicks == []
    qtbot.waitUntil(lambda: not dispense.visibleRegion().isEmpty(), timeout=LONG_MS)
    assert "Dispense: not run" in window.notices.notices()[0].text
    window.toggle_palette()
    palette.field.setText("dispense")
    assert palette.reason.text() == "Press Enter to run it."
    palette.do()
    assert dispense.clicks == ["Dispense"]


def test_what_is_safe_runs_while_its_panel_is_hidden(window, button):
    halt = button("Stop pump")
    offer_in_palette(halt, safe_while_hidden=True)
    window.docks["faults"].close()
    entry(window, "Faults: Stop pump").run()
    assert halt.clicks == ["Stop pump"]


def test_no_command_moves_or_switches_anything_behind_the_operator(qtbot, window, monkeypatch):
    bench, called = window.workbench, []
    safe = {"Stop", "Stop and lock", "Connect …"}
    actions = ("toggle_playback", "release", "undo", "home", "clear_fault", "reconnect", "let_go")
    for name in actions:
        monkeypatch.setattr(bench, name, lambda name=name: called.append(name))
    motion = [e for e in window._entries() if e.where == "Motion" and e.what not in safe]
    assert len(motion) == len(actions)
    for each in motion:
        for dock in window.docks.values():
            dock.close()
        each.run()
    assert called == []


def test_stops_work_while_every_panel_is_hidden(window):
    for dock in window.docks.values():
        dock.close()
    session = window.workbench.session
    before = session.snapshot().stop
    entry(window, "Motion: Stop").run()
    assert session.snapshot().stop is not before
    entry(window, "Motion: Stop and lock").run()
    assert session.snapshot().latched is not None


def test_a_command_whose_panel_is_missing_refers_to_the_menu(window):
    window.panels.make_all()
    for panels in (window.panels.kinds, window.panels.made):
        panels.pop("connection")
    assert entry(window, "Motion: Reconnect").why_not == "its panel is missing; use the menu"
