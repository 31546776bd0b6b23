"""Drawings for a page."""

from rotemina.sim.gap.output import ColourRole, draw_picture
from rotemina.sim.gap.output.svg_pictures import shorten_name


def test_a_long_name_is_shortened_to_one_line():
    assert shorten_name("creep") == "creep"
    assert "\n" not in shorten_name("one\ntwo")
    shortened = shorten_name("x" * 500)
    assert shortened.endswith("…")
    assert len(shortened) < 100


def test_the_same_drawing_is_the_same_text_with_a_description():
    def draw(figure):
        figure.subplots().plot([0.0, 1.0], [1.0, 2.0], color=ColourRole.CORRECTED)

    drawing = draw_picture(3.0, 2.0, draw, 'two "points"')
    assert drawing == draw_picture(3.0, 2.0, draw, 'two "points"')
    assert drawing.startswith('<svg role="img" aria-label="two &quot;points&quot;"')
