"""Readable colours in every theme, and scalable text."""

import re
from importlib import resources
from itertools import combinations

import numpy as np
import pytest

from rotemina.app.widgets.drawing import LINE_STYLES
from rotemina.app.widgets.style import THEMES
from rotemina.app.widgets.style.theme import (
    HIGH_CONTRAST,
    find_text_scale,
    find_theme,
    make_style_sheet,
)

GROUNDS = ("window", "surface", "raised")
#: Text roles used on every ground.
TEXT_ROLES = (
    *("text", "quiet", "accent", "danger_text", "warning", "good"),
    *("command", "model", "real", "other"),
)
#: (text, ground): every text of the style sheet is one of these pairs.
PAIRS = (
    *((role, ground) for role in TEXT_ROLES for ground in GROUNDS),
    ("on_accent", "accent"),
    ("on_danger", "danger"),
    ("window", "warning"),
    ("on_virtual", "virtual"),
)
#: WCAG 2.1, level AA.
MIN_CONTRAST = 4.5
#: ΔE*ab of two lines with the same dashes.
MIN_COLOUR_DISTANCE = 20.0
#: Linear sRGB as dichromats see it (Machado, Oliveira, Fernandes 2009, severity 1).
COLOUR_VISIONS = {
    "usual": np.eye(3),
    "protan": [
        [0.152286, 1.052583, -0.204868],
        [0.114503, 0.786281, 0.099216],
        [-0.003882, -0.048116, 1.051998],
    ],
    "deutan": [
        [0.367322, 0.860646, -0.227968],
        [0.280085, 0.672501, 0.047413],
        [-0.011820, 0.042940, 0.968881],
    ],
    "tritan": [
        [1.255528, -0.076749, -0.178779],
        [-0.078411, 0.930809, 0.147602],
        [0.004733, 0.691367, 0.303900],
    ],
}
#: CIE XYZ of linear sRGB, white at 1.
XYZ_FROM_SRGB = np.array(
    [[0.4339, 0.3762, 0.1899], [0.2127, 0.7152, 0.0722], [0.0178, 0.1095, 0.8727]]
)


def make_linear(colour):
    """Return a colour ``#rrggbb`` in linear sRGB."""
    components = np.array([int(colour[at : at + 2], 16) / 255.0 for at in (1, 3, 5)])
    return np.where(
        components <= 0.04045, components / 12.92, ((components + 0.055) / 1.055) ** 2.4
    )


def compute_contrast(first, second):
    """Return the contrast of two colours ``#rrggbb``, 1 to 21, as WCAG 2.1 defines it."""
    low, high = sorted(make_linear(colour) @ [0.2126, 0.7152, 0.0722] for colour in (first, second))
    return (high + 0.05) / (low + 0.05)


def convert_to_lab(colour, matrix):
    """Return a colour ``#rrggbb`` in CIE L*a*b* as seen with a kind of colour vision."""
    xyz = XYZ_FROM_SRGB @ np.clip(np.asarray(matrix) @ make_linear(colour), 0.0, 1.0)
    root = np.where(xyz > 0.008856, np.cbrt(xyz), 7.787 * xyz + 16.0 / 116.0)
    return np.array([116 * root[1] - 16, 500 * (root[0] - root[1]), 200 * (root[1] - root[2])])


@pytest.mark.parametrize("theme", THEMES.values(), ids=THEMES)
def test_lines_with_the_same_dashes_differ_for_every_colour_vision(theme):
    lines = {(line.role, line.style) for line in LINE_STYLES.values()}
    for (role, style), (other_role, other_style) in combinations(lines, 2):
        if style == other_style:
            for vision, matrix in COLOUR_VISIONS.items():
                first, second = (
                    convert_to_lab(getattr(theme, name), matrix) for name in (role, other_role)
                )
                distance = np.linalg.norm(first - second)
                assert distance > MIN_COLOUR_DISTANCE, (vision, role, other_role)


def test_contrast_follows_the_standard():
    assert compute_contrast("#000000", "#ffffff") == pytest.approx(21.0)
    assert compute_contrast("#777777", "#ffffff") == pytest.approx(4.48, abs=0.01)
    assert compute_contrast("#123456", "#123456") == 1.0


@pytest.mark.parametrize("theme", THEMES.values(), ids=THEMES)
def test_every_role_can_be_read_on_its_ground(theme):
    contrasts = {pair: compute_contrast(*(getattr(theme, role) for role in pair)) for pair in PAIRS}
    assert {pair: value for pair, value in contrasts.items() if value < MIN_CONTRAST} == {}


def test_high_contrast_has_visible_lines_and_strong_text():
    for ground in GROUNDS:
        assert compute_contrast(HIGH_CONTRAST.line, getattr(HIGH_CONTRAST, ground)) >= MIN_CONTRAST
        assert compute_contrast(HIGH_CONTRAST.text, getattr(HIGH_CONTRAST, ground)) >= 15.0


def test_the_style_sheet_uses_only_checked_pairs():
    sheet = resources.files("rotemina.resources.theme").joinpath("window.qss").read_text("utf-8")
    pairs = set(PAIRS)
    used_pairs = set()
    for rule in re.findall(r"\{([^}]*)\}", sheet):
        colour = re.search(r"(?<![-\w])color: \$(\w+)", rule)
        ground = re.search(r"(?<![-\w])background: \$(\w+)", rule)
        if colour and ground:
            used_pairs.add((colour[1], ground[1]))
        elif colour:
            assert colour[1] in {role for role, _ in pairs}, rule
    assert len(used_pairs) > 5
    assert used_pairs <= pairs


def test_all_roles_are_filled_in_and_lengths_except_lines_are_scaled():
    for theme in THEMES.values():
        assert "$" not in make_style_sheet(theme)
    sheet = make_style_sheet(HIGH_CONTRAST, 2.0)
    assert "font-size: 26px" in sheet
    assert "font-size: 13px" not in sheet
    assert "border: 1px solid" in sheet


def test_text_grows_with_the_screen_by_size_classes():
    assert [find_text_scale(lines) for lines in (768, 1080, 1440, 2160)] == [1, 1, 1.15, 1.5]


def test_an_unknown_theme_is_the_dark_one():
    assert find_theme("pink").name == "dark"
    assert find_theme("contrast") is HIGH_CONTRAST
