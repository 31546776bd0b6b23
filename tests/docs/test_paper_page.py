"""The page about the paper: every claim has one line, and what it names can be looked up."""

import re

import pytest

from rotemina.drivers.mc68hc11.axes import BoardAxis
from rotemina.sim.robot.file import load_robot

CLAIMS = 87
TITLE = "Hybrid Micro-Nano Robot for Cell and Cristal Manipulations"
_ROW = re.compile(r"^\| (\d+) \| (.+) \| (.+) \| ([A-Z]) \| (.*) ?\|$", re.MULTILINE)


@pytest.fixture
def text(root):
    return (root / "docs" / "paper.md").read_text("utf-8")


def test_every_claim_has_one_line_in_order(text):
    rows = _ROW.findall(text)
    assert [int(row[0]) for row in rows] == list(range(1, CLAIMS + 1))
    assert {row[3] for row in rows} == set("WPCM")


def test_what_is_there_names_a_test_that_exists(root, text):
    for number, _, _, state, shown in _ROW.findall(text):
        tests = re.findall(r"`([\w/]+\.py)`", shown)
        assert bool(tests) == (state != "M"), f"claim {number}"
        for test in tests:
            assert (root / "tests" / test).is_file(), f"claim {number}: {test}"


def test_page_and_citation_have_the_title_as_it_is_spelled(root, text):
    citation = (root / "docs" / "CITATION.cff").read_text("utf-8")
    assert TITLE in text
    assert f"title: {TITLE}" in citation


@pytest.mark.parametrize(("axis", "step"), [("zn", 1e-9), ("thx", 2e-8), ("thy", 2e-8)])
def test_boards_count_the_steps_that_the_page_says(axis, step):
    assert BoardAxis.of(load_robot("rotemina"), axis, 0).step == step
