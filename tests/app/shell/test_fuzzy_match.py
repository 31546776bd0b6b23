"""What a few letters find first."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotemina.app.shell.fuzzy_match import score

TEXTS = [
    "Motion: Stop and lock",
    "Motion: Stop",
    "Motion: Home all axes",
    "View: Light theme",
    "View: High contrast",
    "View: Smaller text",
    "Panel: Holding plate",
    "Trajectory: Step forward",
]


def best(typed):
    found = {text: score(typed, text) for text in TEXTS}
    return max((text for text in TEXTS if found[text] is not None), key=found.get)


@pytest.mark.parametrize(
    ("typed", "text"),
    [
        ("light", "View: Light theme"),
        ("st", "Motion: Stop"),
        ("hc", "View: High contrast"),
        ("stlo", "Motion: Stop and lock"),
        ("home", "Motion: Home all axes"),
        ("plate", "Panel: Holding plate"),
        ("forw traj", "Trajectory: Step forward"),
        ("STEP", "Trajectory: Step forward"),
    ],
)
def test_letters_find_what_they_are_the_start_of(typed, text):
    assert best(typed) == text


def test_all_words_must_fit_and_nothing_fits_all():
    assert score("stop xyz", "Motion: Stop") is None
    assert score("pots", "Stop") is None
    assert score("", "Stop") == 0.0
    assert score("s", "") is None


@given(st.text(max_size=40), st.data())
def test_letters_of_a_text_in_their_order_always_fit(text, data):
    folded = "".join(text.casefold().split())
    kept = data.draw(st.lists(st.booleans(), min_size=len(folded), max_size=len(folded)))
    letters = "".join(letter for letter, keep in zip(folded, kept, strict=True) if keep)
    assert score(letters, folded) is not None
