import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotemina.plugins.microscope.geometry import GREATEST_ZOOM, Viewport

PICTURE = Viewport(620.0, 480.0, 1300, 1030).fit()
places = st.floats(0.0, 600.0)


def test_fit_shows_all_of_it_in_the_middle():
    assert PICTURE.zoom == pytest.approx(480.0 / 1030)
    assert PICTURE.to_screen(649.5, 514.5) == pytest.approx((310.0, 240.0))
    assert PICTURE.to_screen(-0.5, -0.5)[1] == pytest.approx(0.0)
    assert PICTURE.to_screen(1299.5, 1029.5)[1] == pytest.approx(480.0)
    assert PICTURE.fitted


@given(places, places, st.floats(0.01, 100.0), places, places)
def test_zooming_keeps_what_is_under_the_cursor(x, y, factor, right, down):
    begun = PICTURE.zoomed(8.0, (310.0, 240.0))
    held = begun.to_picture(x, y)
    zoomed = begun.zoomed(factor, (x, y))
    assert min(PICTURE.fitting, 1.0) <= zoomed.zoom <= GREATEST_ZOOM
    inside = 0.0 <= zoomed.at[0] <= 1299.0 and 0.0 <= zoomed.at[1] <= 1029.0
    if inside:  # else it was moved, so that the picture stays in sight
        assert zoomed.to_screen(*held) == pytest.approx((x, y), abs=1e-6)
    moved = zoomed.panned(right, down).panned(-right, -down)
    assert moved.holds(*moved.at) or moved.at[0] == 1299.5 or moved.at[1] == 1029.5


@given(st.floats(-100.0, 1400.0), st.floats(-100.0, 1200.0), st.floats(0.1, 40.0))
def test_screen_and_picture_are_the_same_place(column, row, zoom):
    view = PICTURE.zoomed(zoom, (100.0, 50.0))
    assert view.to_picture(*view.to_screen(column, row)) == pytest.approx((column, row), abs=1e-6)


@given(places, places, st.floats(0.5, 60.0))
def test_the_part_in_sight_covers_the_widget_and_lies_where_it_should(x, y, factor):
    view = PICTURE.zoomed(factor, (x, y))
    part = view.part()
    assert 0 <= part.columns[0] < part.columns[1] <= 1300
    assert 0 <= part.rows[0] < part.rows[1] <= 1030
    # The middle of its last pixel is drawn within one screen pixel of where marks have it.
    last = (
        part.left
        + (part.columns[1] - 0.5 - part.columns[0])
        / (part.columns[1] - part.columns[0])
        * part.width
    )
    assert last == pytest.approx(view.to_screen(part.columns[1] - 1, 0)[0], abs=1.0)
    left, _ = view.to_screen(part.columns[0] - 0.5, 0.0)
    assert left == pytest.approx(part.left)
    assert part.columns[0] == 0 or left <= 0.0
    assert part.columns[1] == 1300 or view.to_screen(part.columns[1] - 0.5, 0)[0] >= 620.0 - 1e-6


def test_one_to_one_and_another_size():
    assert PICTURE.one_to_one().zoom == pytest.approx(1.0)
    assert PICTURE.resized(300.0, 200.0).zoom == pytest.approx(200.0 / 1030)  # fitted stays fitted
    assert PICTURE.one_to_one().resized(300.0, 200.0).zoom == pytest.approx(1.0)
    assert PICTURE.showing(1300, 1030) is PICTURE
    assert PICTURE.one_to_one().showing(40, 30).zoom == pytest.approx(620.0 / 40)
    assert PICTURE.resized(0.0, 0.0).part().width >= 1
