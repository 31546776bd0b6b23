"""Drawings for a page."""

import re

from rotemina.sim.gap.output.report.pictures import Role, picture, short


def drawn(about="two points", name="a"):
    def draw(figure):
        axes = figure.subplots()
        axes.plot([0.0, 1.0], [1.0, 2.0], color=Role.CORRECTED, label=name)
        axes.legend()

    return picture(3.0, 2.0, draw, about)


def test_the_same_drawing_is_the_same_text_in_the_colours_of_the_page():
    once = drawn()
    assert once == drawn()
    assert "var(--corrected)" in once
    assert once.startswith('<svg role="img" aria-label="two points"')


def test_nothing_that_is_pointed_at_is_missing_and_nothing_is_from_outside():
    text = drawn()
    ids = set(re.findall(r' id="([^"]*)"', text))
    assert set(re.findall(r'(?:href="|url\()#([^")]+)', text)) <= ids
    assert "http" not in text
    assert "<style" not in text


def test_names_are_text_and_nothing_else():
    text = drawn(about='"><script>', name="<script>")
    assert "<script>" not in text


def test_a_long_name_is_cut_and_has_one_line():
    assert short("creep") == "creep"
    assert "\n" not in short("one\ntwo")
    cut = short("x" * 500)
    assert cut.endswith("…")
    assert len(cut) < 100
