"""Drawing without OpenGL: projection, hidden surfaces, colours, lines and views."""

import numpy as np
import pytest

from rotemina.plugins.plate.surface_drawing import (
    ColouredSurface,
    OrbitView,
    draw_surface,
    make_colour_table,
    project_points,
)

SIZE = (80, 60)
BLACK, GREY, RED = (0, 0, 0), (100, 100, 100), (255, 0, 0)
ABOVE = OrbitView(azimuth=-90.0, elevation=90.0)
SQUARE = np.array([[-1.0, 1.0, 1.0, -1.0], [-1.0, -1.0, 1.0, 1.0]])
TWO_TRIANGLES = np.array([[0, 0], [1, 2], [2, 3]])
FAR_ROD = np.array([[0.0, 0.0], [0.0, 0.0], [-1.0, -2.0]])


def make_square(height, values):
    points = np.concatenate([SQUARE, np.full((1, 4), height)])
    return ColouredSurface(points, TWO_TRIANGLES, np.array(values), 1.0, FAR_ROD, 0.05)


def get_colour(image, x, y):
    return tuple(int(channel) for channel in image[y, x, 2::-1])


def test_points_are_seen_from_above_and_from_the_side():
    points = np.array([[0.0, 0.5, 0.0], [0.0, 0.0, 0.5], [0.0, 0.0, 0.0]])
    (x0, x1, x2), (y0, y1, y2), _ = project_points(points, ABOVE, 1.0, SIZE)
    assert x1 > x0 == pytest.approx(x2)
    assert y2 < y0 == pytest.approx(y1)
    points = np.array([[0.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
    _, down, near = project_points(points, OrbitView(azimuth=-90.0, elevation=0.0), 1.0, SIZE)
    assert down[1] < down[0]
    assert near[2] > near[0]  # at azimuth -90° the viewer is at -y


def test_rotation_keeps_distances_when_seen_from_above():
    points = np.concatenate([SQUARE, np.zeros((1, 4))])
    for azimuth in (0.0, 33.0, 250.0):
        right, down, _ = project_points(points, OrbitView(azimuth, 90.0), 1.0, SIZE)
        sides = np.hypot(np.diff(right), np.diff(down))
        assert sides == pytest.approx(sides[0])


def test_values_become_colours_and_triangles_join_without_gaps():
    image = draw_surface(make_square(0.0, [0.0, 1.0]), ABOVE, SIZE, BLACK, GREY, None)
    inner_colours = image[20:30, 30:50, 2::-1].reshape(-1, 3)
    end_colours = np.array([make_colour_table()[0], make_colour_table()[-1]])
    differences = inner_colours[:, None, :].astype(int) - end_colours
    # Only the two colours or their mix appear; no background is visible along the diagonal.
    assert np.abs(differences).sum(axis=2).min(axis=1).max() < 300
    assert inner_colours.sum(axis=1).min() > 60
    assert get_colour(image, 1, 1) == BLACK


@pytest.mark.parametrize("order", [(0, 1), (1, 0)])
def test_the_nearer_surface_hides_the_other(order):
    heights, values = np.array([0.0, 0.5])[list(order)], np.array([0.0, 1.0])[list(order)]
    points = np.concatenate(
        [np.concatenate([SQUARE, np.full((1, 4), height)]) for height in heights], axis=1
    )
    surface = ColouredSurface(
        points,
        np.concatenate([TWO_TRIANGLES, TWO_TRIANGLES + 4], axis=1),
        np.repeat(values, 2),
        1.0,
        FAR_ROD,
        0.05,
    )
    above = draw_surface(surface, ABOVE, SIZE, BLACK, GREY, None)
    assert get_colour(above, 40, 25) == tuple(make_colour_table()[-1])
    below = draw_surface(surface, OrbitView(-90.0, -90.0), SIZE, BLACK, GREY, None)
    assert get_colour(below, 45, 25) == tuple(make_colour_table()[0])


def test_mesh_lines_are_drawn_and_parts_without_value_are_grey():
    lines = draw_surface(make_square(0.0, [0.5, 0.5]), ABOVE, SIZE, BLACK, GREY, RED)
    redness = lines[10:40, 25:55, 2].astype(int) - lines[10:40, 25:55, 0]
    assert redness.max() > 100
    neutral = draw_surface(make_square(0.0, [np.nan, np.nan]), ABOVE, SIZE, BLACK, GREY, RED)
    assert get_colour(neutral, 40, 25) == GREY


def test_views_rotate_and_zoom_within_bounds():
    view = OrbitView().with_rotation(30.0, 400.0)
    assert view.elevation == 90.0
    assert view.with_rotation(0.0, -900.0).elevation == -90.0
    assert OrbitView().with_zoom(1e9).zoom == 20.0
    assert OrbitView().with_zoom(0.0).zoom == 0.3
    for zoom in (0.3, 20.0):  # much larger and much smaller than the picture
        draw_surface(make_square(0.0, [0.0, 1.0]), OrbitView(zoom=zoom), SIZE, BLACK, GREY, RED)
