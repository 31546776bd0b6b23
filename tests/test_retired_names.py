"""Names that say nothing to a control or robotics engineer do not come back."""

import ast
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
LAYERS = ("app", "drivers", "plugins", "sim")
# Whole identifiers, less a leading underscore: their parts are common words.
RETIRED = {
    "Acting", "Arm", "Course", "Filming", "Hand", "Hands", "Happening", "Heard", "Hiding", "Known",
    "Leg", "Left", "Lever", "Looking", "Met", "OperatorDesk", "Place", "Prospect", "Seat", "Sight",
    "Told", "Tour", "Using", "Visits", "Wish", "bell", "cry", "farewell", "hush",
    "looked_at", "sight_of", "told_of",
}  # fmt: skip
MODULES = {
    "acting", "actuation", "ahead", "asking", "attempts", "bars", "beside", "calibrating",
    "caution", "chance", "closing", "compensating", "connected", "contest", "copies", "course",
    "demonstration", "draft", "edits", "excursions", "exits", "extras", "far", "fast",
    "finding", "finely", "fitted", "fuzzy", "ground", "hand", "hands", "headline", "held",
    "holding", "host", "joined", "joining", "kept", "known", "lateness", "lead", "leaps",
    "learning", "leaving", "left", "levels", "listing", "live", "look", "meanings", "measuring",
    "naive", "operator_desk", "orders", "overlay", "pending", "pieces", "proof", "prospect",
    "question", "rail", "reasons", "regulating", "repeats", "reserve", "richness", "searching",
    "serving", "sight", "sight_of", "solved", "solving", "spread", "stages", "standing",
    "steady", "stepped", "stepping", "stuck", "subject", "swings", "teeth", "teleoperator",
    "telling", "told", "tones", "transport", "trials", "twin", "unchecked", "unfinished",
    "uploading", "using", "visits", "voltage", "wander", "watched", "way", "where", "which",
    "whiteness",
}  # fmt: skip


def names_of(source):
    """Yield the names of classes, functions and attributes that a source defines."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.ClassDef | ast.FunctionDef):
            yield node.name
        elif isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store):
            yield node.attr


def retired_in(path, source):
    found = {name for name in names_of(source) if name.lstrip("_") in RETIRED}
    return found | ({path.stem} & MODULES)


@pytest.mark.parametrize("layer", LAYERS)
def test_no_retired_name_comes_back(layer):
    found = {
        path.relative_to(ROOT).as_posix(): names
        for path in sorted((ROOT / layer).rglob("*.py"))
        if (names := retired_in(path, path.read_text("utf-8")))
    }
    assert found == {}


@pytest.mark.parametrize(
    ("path", "source"),
    [
        ("left.py", ""),
        ("a.py", "class _Lever:\n    pass"),
        ("a.py", "def told_of():\n    pass"),
        ("a.py", "class A:\n    def __init__(self):\n        self.bell = 0"),
    ],
)
def test_a_retired_name_is_found(path, source):
    assert retired_in(Path(path), source)


def test_a_common_word_in_another_name_is_none():
    assert not retired_in(Path("seat.py"), "class SeatForce:\n    left = 0\n\ndef place(): ...")
