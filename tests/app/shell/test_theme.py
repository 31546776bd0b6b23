"""Colours that can be read in every theme, and text of every size."""

import re
from importlib import resources

import pytest

from rotemina.app.shell.theme import (
    GROUNDS,
    HIGH_CONTRAST,
    PAIRS,
    THEMES,
    contrast,
    scale_for,
    style_sheet,
    theme_named,
)

LEAST = 4.5  # WCAG 2.1, level AA


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
