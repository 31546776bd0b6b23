"""The blind test page: its separate process, progress, stop and result."""

import json
import sys

import pytest
from PySide6.QtCore import Qt

from rotemina.plugins.gap.blind import BlindPage, blind_run
from rotemina.plugins.gap.blind.blind_figures import BlindResult
from rotemina.plugins.gap.blind.blind_page import translate_outcome
from rotemina.sim.errors import InputError

LONG_MS = 30_000
SCORE = {
    "done": 3,
    "asked": 12,
    "figures": {
        "top_1_large_gap": {"value": 0.98, "interval": [0.9, 0.99], "n": 50},
        "set_size": {"value": 1.4, "interval": [1.2, 1.6], "n": 50},
        "false_accusations": {"value": 0.0, "interval": [0.0, 0.2], "n": 14},
        "seconds_greatest": {"value": 131.0, "interval": [90.0, 131.0], "n": 50},
        "top_1": {"value": 0.9, "interval": [0.8, 0.95], "n": 80},
        "two_exact": {"value": None, "interval": [None, None], "n": 0},
    },
    "confusion": [
        {"truth": "creep", "named": "creep", "number": 2},
        {"truth": "creep", "named": "none", "number": 1},
        {"truth": "none", "named": "none", "number": 4},
    ],
}
WORKER = """
import json, sys, signal
print("case_0000: done (1 of 2)", file=sys.stderr, flush=True)
arguments = dict(zip(sys.argv[1::2], sys.argv[2::2]))
if arguments["--cases"] == "2":
    signal.pause()
if arguments["--cases"] == "3":
    sys.exit("rotemina: this cannot be")
with open(arguments["--json"], "w") as file:
    file.write('''SCORE''')
"""


@pytest.fixture
def result(tmp_path):
    (tmp_path / "score.json").write_text(json.dumps(SCORE), "utf-8")
    return BlindResult.read(tmp_path / "score.json")


@pytest.fixture
def page(window, monkeypatch, tmp_path):
    script = WORKER.replace("SCORE", json.dumps(SCORE))
    monkeypatch.setattr(blind_run, "_COMMAND_ARGUMENTS", ("-c", script))
    (tmp_path / "blind" / "RoTeMiNa-seed-1").mkdir(parents=True)
    window.panel.show_blind_test()
    assert isinstance(window.panel.blind, BlindPage)
    return window.panel.blind


def test_figures_are_compared_with_their_target_levels(result):
    levels_reached = {row.cells[0]: row.reached for row in result.rows}
    assert levels_reached == {
        "… where the gap is ≥ 5 floors": True,
        "mean size of the set": False,
        "false alarms on healthy machines": True,
        "seconds per case, maximum": False,
        "first cause correct, one effect": None,
        "exactly two effects": None,
    }
    assert result.rows[0].cells[1:] == ("≥ 98 %", "98.0 % (90.0–99.0)", "50")
    assert result.rows[-1].cells[2] == "–"


def test_shares_of_the_matrix_refer_to_the_true_cause(result):
    assert result.names == ("creep", "none")
    assert result.compute_share("creep", "creep") == pytest.approx(2 / 3)
    assert result.compute_share("none", "creep") == 0.0
    assert translate_outcome("none") == "no gap"
    assert translate_outcome("creep") == "Creep"


def test_an_unreadable_result_is_refused(tmp_path):
    with pytest.raises(InputError, match="run it again"):
        BlindResult.read(tmp_path / "missing.json")
    (tmp_path / "half.json").write_text("{")
    with pytest.raises(InputError, match=r"half\.json"):
        BlindResult.read(tmp_path / "half.json")


def test_a_blind_test_runs_and_shows_its_result(qtbot, window, page):
    progress = []
    page.run.progressed.connect(lambda *counts: progress.append(counts))
    assert page.nothing.isVisible()
    with qtbot.waitSignal(page.run.finished, timeout=LONG_MS):
        qtbot.mouseClick(page.start, Qt.MouseButton.LeftButton)
        assert not page.start.isEnabled()
        assert page.stop.isEnabled()
    assert progress == [(1, 2)]
    assert page.doing.text() == "3 of 12 cases scored"
    assert page.shown.isVisible()
    assert page.figures.read_texts()[0][0] == "… where the gap is ≥ 5 floors"
    assert page.matrix.read_texts() == [["Creep", "2", "1"], ["no gap", "", "4"]]
    assert "33.3 %" in page.matrix.item(0, 2).toolTip()
    window.use_theme("light")
    assert page.matrix.item(0, 1).background().color().alpha() > 0
    page.seed.clear()
    assert not page.start.isEnabled()  # a test needs a seed


def test_a_blind_test_can_be_stopped_and_ends_with_the_window(qtbot, window, page):
    page.cases.setText("2")
    with qtbot.waitSignal(page.run.progressed, timeout=LONG_MS):
        page.begin(score=False)
    with qtbot.waitSignal(page.run.stopped, timeout=LONG_MS):
        qtbot.mouseClick(page.stop, Qt.MouseButton.LeftButton)
    assert page.doing.text() == "stopped; finished cases are kept"
    assert page.start.isEnabled()
    with qtbot.waitSignal(page.run.progressed, timeout=LONG_MS):
        page.begin(score=False)
    window.workbench.closing.emit()
    assert not page.run.running


def test_a_failed_blind_test_is_reported(qtbot, window, page, monkeypatch):
    page.cases.setText("3")
    with qtbot.waitSignal(page.run.failed, timeout=LONG_MS):
        page.begin(score=False)
    assert "this cannot be" in window.notices[-1]
    monkeypatch.setattr(sys, "executable", "/nowhere/python")
    with qtbot.waitSignal(page.run.failed, timeout=LONG_MS):
        page.begin(score=True)
    assert "cannot be started" in window.notices[-1]
    assert not page.run.running
