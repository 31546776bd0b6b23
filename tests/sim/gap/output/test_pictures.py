"""Drawings for a page."""

import re

from rotemina.sim.gap.output import ColourRole, draw_picture
from rotemina.sim.gap.output.svg_pictures import shorten_name


def draw_example(description="two points", name="a"):
    def draw(figure):
        axes = figure.subplots()
        axes.plot([0.0, 1.0], [1.0, 2.0], color=ColourRole.CORRECTED, label=name)
        axes.legend()

    return draw_picture(3.0, 2.0, draw, description)


def test_the_same_drawing_is_the_same_text_in_the_colours_of_the_page():
    drawing = draw_example()
    assert drawing == draw_example()
    assert "var(--corrected)" in drawing
    assert drawing.startswith('<svg role="img" aria-label="two points"')


def test_links_have_targets_and_nothing_is_loaded_from_outside():
    text = draw_example()
    ids = set(re.findall(r' id="([^"]*)"', text))
    assert set(re.findall(r'(?:href="|url\()#([^")]+)', text)) <= ids
    assert "http" not in text
    assert "<style" not in text


def test_names_are_text_and_nothing_else():
    text = draw_example(description='"><script>', name="<script>")
    assert "<script>" not in text


def test_a_long_name_is_shortened_to_one_line():
    assert shorten_name("creep") == "creep"
    assert "\n" not in shorten_name("one\ntwo")
    shortened = shorten_name("x" * 500)
    assert shortened.endswith("…")
    assert len(shortened) < 100
