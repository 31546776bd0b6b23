"""A hidden machine in the window: drawn, played, revealed beside what was said, and counted."""

from dataclasses import replace

import pytest
from PySide6.QtWidgets import QMessageBox

from rotemina.app.blind.hidden_machine import HiddenMachine, Secret
from rotemina.plugins.gap import hidden_machine
from rotemina.plugins.gap.diagnosis_answer import Answer

LONG_MS = 60_000


class ToldSecret(Secret):
    """A secret of which the causes are said."""

    __slots__ = ("_causes",)

    def __init__(self, causes):
        super().__init__(1, None)
        object.__setattr__(self, "_causes", frozenset(causes))

    @property
    def causes(self):
        return self._causes


@pytest.fixture
def hiding(qtbot, window, monkeypatch):
    monkeypatch.setattr(hidden_machine, "draw_secret", lambda *_: ToldSecret({("thx", "creep")}))
    panel = window.panel
    panel.hidden_trial.begin(1)
    session = window.workbench.session
    qtbot.waitUntil(lambda: panel.hidden_trial.secret is not None, timeout=LONG_MS)
    qtbot.waitUntil(lambda: session.snapshot().locked is None, timeout=LONG_MS)
    return panel.hidden_trial


def boxes(window):
    return [box for box in window.findChildren(QMessageBox) if box.isVisible()]


def test_it_is_driven_like_any_other_and_revealed_beside_the_answer(
    qtbot, window, hiding, diagnosis, record
):
    session = window.workbench.session
    assert isinstance(session.driver, HiddenMachine)
    assert session.service.effects == ()
    assert "More → Reveal" in window.told[-1]
    session.jog("zn", 1e-6)
    answer = Answer.of(diagnosis, ["day one.csv"], [record])  # hysteresis, or creep
    hiding.reveal(answer)
    (box,) = boxes(window)
    assert box.text().startswith("Correct")
    assert "The machine has: θx creep" in box.informativeText()
    assert "Score: 1 of 1" in box.informativeText()
    box.close()
    qtbot.waitUntil(lambda: session.driver.name == "simulator", timeout=LONG_MS)
    assert hiding.secret is None


def test_what_is_not_named_counts_against_it(window, hiding, diagnosis):
    hiding.reveal(None)
    (box,) = boxes(window)
    assert box.text() == "Not correct."
    assert "The diagnosis names: nothing" in box.informativeText()
    assert "Score: 0 of 1" in box.informativeText()
    assert replace(diagnosis).causes  # untouched
