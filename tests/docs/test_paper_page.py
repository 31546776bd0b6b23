"""The page about the paper: every claim has one line, and the tests that it names exist."""

import re

import pytest

from rotemina.drivers.mc68hc11.protocol import BoardAxis
from rotemina.sim.robot_files import load_robot

CLAIM_COUNT = 87
TITLE = "Hybrid Micro-Nano Robot for Cell and Cristal Manipulations"
_ROW = re.compile(r"^\| (\d+) \| (.+) \| (.+) \| ([A-Z]) \| (.*) ?\|$", re.MULTILINE)


@pytest.fixture
def text(root):
    return (root / "docs" / "paper.md").read_text("utf-8")


def test_every_claim_has_one_line_in_order(text):
    rows = _ROW.findall(text)
    assert [int(row[0]) for row in rows] == list(range(1, CLAIM_COUNT + 1))
    assert {row[3] for row in rows} == set("WPCM")


def test_every_implemented_claim_names_a_test_that_exists(root, text):
    for number, _, _, state, evidence in _ROW.findall(text):
        tests = re.findall(r"`([\w/]+\.py)`", evidence)
        assert bool(tests) == (state != "M"), f"claim {number}"
        for test in tests:
            assert (root / "tests" / test).is_file(), f"claim {number}: {test}"


def test_page_and_citation_spell_the_title_like_the_paper(root, text):
    citation = (root / "docs" / "CITATION.cff").read_text("utf-8")
    assert TITLE in text
    assert f"title: {TITLE}" in citation


@pytest.mark.parametrize(("axis", "step"), [("zn", 1e-9), ("thx", 2e-8), ("thy", 2e-8)])
def test_boards_have_the_step_sizes_on_the_page(axis, step):
    assert BoardAxis.from_robot(load_robot("rotemina"), axis, 0).step_size == step
