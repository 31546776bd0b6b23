"""Colours that can be read in every theme, and text of every size."""

import re
from importlib import resources

import numpy as np
import pytest

from rotemina.app.shell.plot import LINES
from rotemina.app.shell.theme import (
    HIGH_CONTRAST,
    THEMES,
    scale_for,
    style_sheet,
    theme_named,
)

GROUNDS = ("window", "surface", "raised")
#: Roles that are read on every ground.
READ = (
    *("text", "quiet", "accent", "danger_text", "warning", "good"),
    *("command", "model", "real", "other"),
)
#: What is read, and on what: every text of the style sheet is one of these.
PAIRS = (
    *((role, ground) for role in READ for ground in GROUNDS),
    ("on_accent", "accent"),
    ("on_danger", "danger"),
    ("window", "warning"),
    ("on_virtual", "virtual"),
)
LEAST = 4.5  # WCAG 2.1, level AA
TOLD_APART = 20.0  # ΔE*ab of two lines that have the same dashes
#: How dichromats see linear sRGB (Machado, Oliveira, Fernandes 2009, severity 1).
EYES = {
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
XYZ = np.array([[0.4339, 0.3762, 0.1899], [0.2127, 0.7152, 0.0722], [0.0178, 0.1095, 0.8727]])


def contrast(one, other):
    """Return the contrast of two colours ``#rrggbb``, 1 to 21, as WCAG 2.1 defines it."""
    low, high = sorted((_luminance(one), _luminance(other)))
    return (high + 0.05) / (low + 0.05)


def _luminance(colour):
    shares = [int(colour[at : at + 2], 16) / 255.0 for at in (1, 3, 5)]
    linear = [
        share / 12.92 if share <= 0.04045 else ((share + 0.055) / 1.055) ** 2.4 for share in shares
    ]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def lab(colour, eye):
    """Return a colour ``#rrggbb`` in CIE L*a*b* as an eye sees it."""
    shares = np.array([int(colour[at : at + 2], 16) / 255.0 for at in (1, 3, 5)])
    linear = np.where(shares <= 0.04045, shares / 12.92, ((shares + 0.055) / 1.055) ** 2.4)
    seen = XYZ @ np.clip(np.asarray(eye) @ linear, 0.0, 1.0)
    root = np.where(seen > 0.008856, np.cbrt(seen), 7.787 * seen + 16.0 / 116.0)
    return np.array([116 * root[1] - 16, 500 * (root[0] - root[1]), 200 * (root[1] - root[2])])


@pytest.mark.parametrize("eye", EYES.values(), ids=EYES)
@pytest.mark.parametrize("theme", THEMES.values(), ids=THEMES)
def test_lines_of_the_same_dashes_are_told_apart_by_every_eye(theme, eye):
    lines = list({(line.role, line.style): line for line in LINES.values()}.values())
    for number, one in enumerate(lines):
        for other in lines[number + 1 :]:
            if one.style == other.style:
                roles = (one.role, other.role)
                first, second = (lab(getattr(theme, role), eye) for role in roles)
                assert np.linalg.norm(first - second) > TOLD_APART, roles


def test_contrast_is_that_of_the_standard():
    assert contrast("#000000", "#ffffff") == pytest.approx(21.0)
    assert contrast("#777777", "#ffffff") == pytest.approx(4.48, abs=0.01)
    assert contrast("#123456", "#123456") == 1.0


@pytest.mark.parametrize("theme", THEMES.values(), ids=THEMES)
@pytest.mark.parametrize("pair", PAIRS, ids="-on-".join)
def test_every_role_can_be_read_on_its_ground(theme, pair):
    assert contrast(*(getattr(theme, role) for role in pair)) >= LEAST


def test_high_contrast_has_visible_lines_and_strong_text():
    for ground in GROUNDS:
        assert contrast(HIGH_CONTRAST.line, getattr(HIGH_CONTRAST, ground)) >= LEAST
        assert contrast(HIGH_CONTRAST.text, getattr(HIGH_CONTRAST, ground)) >= 15.0


def test_the_style_sheet_sets_no_text_on_a_ground_that_is_no_pair():
    sheet = resources.files("rotemina.resources.theme").joinpath("window.qss").read_text("utf-8")
    pairs = set(PAIRS)
    found = set()
    for rule in re.findall(r"\{([^}]*)\}", sheet):
        colour = re.search(r"(?<![-\w])color: \$(\w+)", rule)
        ground = re.search(r"(?<![-\w])background: \$(\w+)", rule)
        if colour and ground:
            found.add((colour[1], ground[1]))
        elif colour:
            assert colour[1] in {role for role, _ in pairs}, rule
    assert len(found) > 5
    assert found <= pairs


def test_a_style_sheet_has_no_role_left_and_scales_lengths_but_lines():
    for theme in THEMES.values():
        assert "$" not in style_sheet(theme)
    sheet = style_sheet(HIGH_CONTRAST, 2.0)
    assert "font-size: 26px" in sheet
    assert "font-size: 13px" not in sheet
    assert "border: 1px solid" in sheet


def test_text_grows_with_the_screen_by_size_classes():
    assert [scale_for(lines) for lines in (768, 800, 1080, 1440, 2160)] == [1, 1, 1, 1.15, 1.5]


def test_an_unknown_theme_is_the_dark_one():
    assert theme_named("pink").name == "dark"
    assert theme_named("contrast") is HIGH_CONTRAST
