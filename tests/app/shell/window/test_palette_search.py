"""Fuzzy matching of command names."""

import pytest
from hypothesis import given, settings, strategies as st

from rotemina.app.shell.window.palette_search import score_match

TEXTS = [
    "Motion: Stop and lock",
    "Motion: Stop",
    "View: Light theme",
    "View: High contrast",
    "View: Smaller text",
    "Trajectory: Step forward",
]


def find_best_match(query):
    scores = {text: score_match(query, text) for text in TEXTS}
    return max((text for text in TEXTS if scores[text] is not None), key=scores.get)


@pytest.mark.parametrize(
    ("query", "text"),
    [
        ("light", "View: Light theme"),
        ("st", "Motion: Stop"),
        ("hc", "View: High contrast"),
        ("stlo", "Motion: Stop and lock"),
        ("forw traj", "Trajectory: Step forward"),
        ("STEP", "Trajectory: Step forward"),
    ],
)
def test_the_best_match_is_found(query, text):
    assert find_best_match(query) == text


def test_all_words_must_match_and_an_empty_query_matches_everything():
    assert score_match("stop xyz", "Motion: Stop") is None
    assert score_match("pots", "Stop") is None
    assert score_match("", "Stop") == 0.0
    assert score_match("s", "") is None


@settings(max_examples=25)
@given(st.text(max_size=40), st.data())
def test_any_subsequence_of_a_text_matches_it(text, data):
    folded = "".join(text.casefold().split())
    mask = data.draw(st.lists(st.booleans(), min_size=len(folded), max_size=len(folded)))
    letters = "".join(letter for letter, keep in zip(folded, mask, strict=True) if keep)
    assert score_match(letters, folded) is not None
