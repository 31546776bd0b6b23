"""A small blind test with the real diagnosis, from the command line to its page."""

import json
import shutil
from pathlib import Path

import pytest

from rotemina.app.cli.main import main

CASES = 2
# Training of a classifier for the naive methods takes long.
CLASSIFIER = Path(__file__).parents[2] / "samples/data/blind/RoTeMiNa-seed-7/classifier.npz"


@pytest.mark.slow
def test_a_few_sealed_cases_are_diagnosed_and_scored(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "run").mkdir()
    shutil.copy(CLASSIFIER, tmp_path / "run")
    arguments = ["gap", "blind", "--cases", str(CASES), "--seed", "1377", "--folder", "run"]
    assert main([*arguments, "--shard", "1/2"]) == 0
    assert main([*arguments, "--json", "score.json", "--report", "page.md"]) == 0
    assert capsys.readouterr().err.count("done (") == CASES
    score = json.loads((tmp_path / "score.json").read_text())
    assert score["done"] == score["asked"] == CASES
    assert all(case["answer"]["verdict"] != "failed" for case in score["wrong"])
    assert score["figures"]["false_accusations"]["value"] in (None, 0.0)
    assert "confusion" in (tmp_path / "page.md").read_text().lower()
