"""A hidden machine in the window: drawn, moved, revealed with the diagnosis, and scored."""

import pytest
from PySide6.QtWidgets import QMessageBox

from rotemina.app.blind import HiddenEffects, HiddenMachineSimulator
from rotemina.plugins.gap.answer import DiagnosisAnswer
from rotemina.plugins.gap.blind import hidden_machine

LONG_MS = 60_000


class KnownHiddenEffects(HiddenEffects):
    """Hidden effects whose causes are known to the test."""

    __slots__ = ("_causes",)

    def __init__(self, causes):
        super().__init__(1, None)
        object.__setattr__(self, "_causes", frozenset(causes))

    @property
    def causes(self):
        return self._causes


@pytest.fixture
def hidden_trial(qtbot, window, monkeypatch):
    monkeypatch.setattr(
        hidden_machine, "draw_hidden_effects", lambda *_: KnownHiddenEffects({("thx", "creep")})
    )
    panel = window.panel
    panel.hidden_trial.begin(1)
    session = window.workbench.session
    qtbot.waitUntil(lambda: panel.hidden_trial.hidden_effects is not None, timeout=LONG_MS)
    qtbot.waitUntil(lambda: session.snapshot().lock_reason is None, timeout=LONG_MS)
    return panel.hidden_trial


def find_boxes(window):
    return [box for box in window.findChildren(QMessageBox) if box.isVisible()]


def test_a_hidden_machine_moves_like_any_other_and_is_revealed_with_the_answer(
    qtbot, window, hidden_trial, diagnosis, record
):
    session = window.workbench.session
    assert isinstance(session.driver, HiddenMachineSimulator)
    assert session.service.effects == ()
    assert "More → Reveal" in window.notices[-1]
    session.jog("zn", 1e-6)
    # The diagnosis names hysteresis or creep.
    answer = DiagnosisAnswer.from_diagnosis(diagnosis, ["day one.csv"], [record])
    hidden_trial.reveal(answer)
    (box,) = find_boxes(window)
    assert box.text().startswith("Correct")
    assert "The machine has: θx creep" in box.informativeText()
    assert "Score: 1 of 1" in box.informativeText()
    box.close()
    qtbot.waitUntil(lambda: session.driver.name == "simulator", timeout=LONG_MS)
    assert hidden_trial.hidden_effects is None


def test_revealing_without_an_answer_scores_zero(window, hidden_trial):
    hidden_trial.reveal(None)
    (box,) = find_boxes(window)
    assert box.text() == "Not correct."
    assert "The diagnosis names: nothing" in box.informativeText()
    assert "Score: 0 of 1" in box.informativeText()
