import pytest
from hypothesis import given, strategies as st

from rotemina.plugins.microscope.geometry import MAX_ZOOM, Viewport

PICTURE = Viewport(620.0, 480.0, 1300, 1030).zoom_to_fit()
coordinates = st.floats(0.0, 600.0)


def test_fit_centres_the_whole_picture():
    assert PICTURE.zoom == pytest.approx(480.0 / 1030)
    assert PICTURE.to_screen(649.5, 514.5) == pytest.approx((310.0, 240.0))
    assert PICTURE.to_screen(-0.5, -0.5)[1] == pytest.approx(0.0)
    assert PICTURE.to_screen(1299.5, 1029.5)[1] == pytest.approx(480.0)
    assert PICTURE.fitted


@given(coordinates, coordinates, st.floats(0.01, 100.0), coordinates, coordinates)
def test_zooming_keeps_the_pixel_under_the_cursor(x, y, factor, right, down):
    start = PICTURE.zoom_about(8.0, (310.0, 240.0))
    anchored_pixel = start.to_picture(x, y)
    zoomed = start.zoom_about(factor, (x, y))
    assert min(PICTURE.fit_zoom, 1.0) <= zoomed.zoom <= MAX_ZOOM
    is_inside = 0.0 <= zoomed.at[0] <= 1299.0 and 0.0 <= zoomed.at[1] <= 1029.0
    if is_inside:  # otherwise the picture is moved back into view
        assert zoomed.to_screen(*anchored_pixel) == pytest.approx((x, y), abs=1e-6)
    moved = zoomed.pan_by(right, down).pan_by(-right, -down)
    assert moved.contains(*moved.at) or moved.at[0] == 1299.5 or moved.at[1] == 1029.5


@given(st.floats(-100.0, 1400.0), st.floats(-100.0, 1200.0), st.floats(0.1, 40.0))
def test_screen_and_picture_coordinates_are_inverse(column, row, zoom):
    view = PICTURE.zoom_about(zoom, (100.0, 50.0))
    assert view.to_picture(*view.to_screen(column, row)) == pytest.approx((column, row), abs=1e-6)


@given(coordinates, coordinates, st.floats(0.5, 60.0))
def test_the_visible_part_covers_the_widget_and_is_aligned(x, y, factor):
    view = PICTURE.zoom_about(factor, (x, y))
    part = view.find_visible_part()
    assert 0 <= part.columns[0] < part.columns[1] <= 1300
    assert 0 <= part.rows[0] < part.rows[1] <= 1030
    # The centre of the last pixel is drawn within one screen pixel of its mark.
    last_centre = (
        part.left
        + (part.columns[1] - 0.5 - part.columns[0])
        / (part.columns[1] - part.columns[0])
        * part.width
    )
    assert last_centre == pytest.approx(view.to_screen(part.columns[1] - 1, 0)[0], abs=1.0)
    left, _ = view.to_screen(part.columns[0] - 0.5, 0.0)
    assert left == pytest.approx(part.left)
    assert part.columns[0] == 0 or left <= 0.0
    assert part.columns[1] == 1300 or view.to_screen(part.columns[1] - 0.5, 0)[0] >= 620.0 - 1e-6


def test_zoom_one_to_one_and_size_changes():
    assert PICTURE.zoom_one_to_one().zoom == pytest.approx(1.0)
    # A fitted picture stays fitted.
    assert PICTURE.with_widget_size(300.0, 200.0).zoom == pytest.approx(200.0 / 1030)
    assert PICTURE.zoom_one_to_one().with_widget_size(300.0, 200.0).zoom == pytest.approx(1.0)
    assert PICTURE.with_picture_size(1300, 1030) is PICTURE
    assert PICTURE.zoom_one_to_one().with_picture_size(40, 30).zoom == pytest.approx(620.0 / 40)
    assert PICTURE.with_widget_size(0.0, 0.0).find_visible_part().width >= 1
