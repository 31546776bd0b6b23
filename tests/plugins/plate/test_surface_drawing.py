"""Drawing without OpenGL: projection, what hides what, colours, and its speed's order."""

import numpy as np
import pytest

from rotemina.plugins.plate.surface_drawing import Surface, View, colours, drawn, projected

SIZE = (80, 60)
BLACK, GREY, RED = (0, 0, 0), (100, 100, 100), (255, 0, 0)
ABOVE = View(azimuth=-90.0, elevation=90.0)
SQUARE = np.array([[-1.0, 1.0, 1.0, -1.0], [-1.0, -1.0, 1.0, 1.0]])
TWO = np.array([[0, 0], [1, 2], [2, 3]])
FAR_ROD = np.array([[0.0, 0.0], [0.0, 0.0], [-1.0, -2.0]])


def square(height, values):
    points = np.concatenate([SQUARE, np.full((1, 4), height)])
    return Surface(points, TWO, np.array(values), 1.0, FAR_ROD, 0.05)


def colour_at(image, x, y):
    return tuple(int(part) for part in image[y, x, 2::-1])


def test_from_above_x_is_right_and_y_is_up():
    points = np.array([[0.0, 0.5, 0.0], [0.0, 0.0, 0.5], [0.0, 0.0, 0.0]])
    (x0, x1, x2), (y0, y1, y2), _ = projected(points, ABOVE, 1.0, SIZE)
    assert x1 > x0 == pytest.approx(x2)
    assert y2 < y0 == pytest.approx(y1)


def test_from_the_side_z_is_up_and_nearer_is_nearer():
    points = np.array([[0.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
    _, down, near = projected(points, View(azimuth=-90.0, elevation=0.0), 1.0, SIZE)
    assert down[1] < down[0]
    assert near[2] > near[0]  # azimuth -90: seen from -y


def test_turning_keeps_distances_at_an_elevation_of_90():
    points = np.concatenate([SQUARE, np.zeros((1, 4))])
    for azimuth in (0.0, 33.0, 250.0):
        right, down, _ = projected(points, View(azimuth, 90.0), 1.0, SIZE)
        sides = np.hypot(np.diff(right), np.diff(down))
        assert sides == pytest.approx(sides[0])


def test_values_become_colours_and_borders_do_not_gape():
    image = drawn(square(0.0, [0.0, 1.0]), ABOVE, SIZE, BLACK, GREY, None)
    inside = image[20:30, 30:50, 2::-1].reshape(-1, 3)
    ends = np.array([colours()[0], colours()[-1]])
    between = inside[:, None, :].astype(int) - ends
    # Only the two colours, or one smoothed into the other; no background shows at the diagonal.
    assert np.abs(between).sum(axis=2).min(axis=1).max() < 300
    assert inside.sum(axis=1).min() > 60
    assert colour_at(image, 1, 1) == BLACK


@pytest.mark.parametrize("order", [(0, 1), (1, 0)])
def test_the_nearer_surface_hides_the_other(order):
    heights, shades = np.array([0.0, 0.5])[list(order)], np.array([0.0, 1.0])[list(order)]
    points = np.concatenate(
        [np.concatenate([SQUARE, np.full((1, 4), height)]) for height in heights], axis=1
    )
    surface = Surface(
        points, np.concatenate([TWO, TWO + 4], axis=1), np.repeat(shades, 2), 1.0, FAR_ROD, 0.05
    )
    seen = drawn(surface, ABOVE, SIZE, BLACK, GREY, None)
    assert colour_at(seen, 40, 25) == tuple(colours()[-1])
    below = drawn(surface, View(-90.0, -90.0), SIZE, BLACK, GREY, None)
    assert colour_at(below, 45, 25) == tuple(colours()[0])


def test_mesh_lines_and_neutral_parts():
    lines = drawn(square(0.0, [0.5, 0.5]), ABOVE, SIZE, BLACK, GREY, RED)
    reddest = lines[10:40, 25:55, 2].astype(int) - lines[10:40, 25:55, 0]
    assert reddest.max() > 100
    neutral = drawn(square(0.0, [np.nan, np.nan]), ABOVE, SIZE, BLACK, GREY, RED)
    assert colour_at(neutral, 40, 25) == GREY


def test_views_turn_and_zoom_within_bounds():
    view = View().turned(30.0, 400.0)
    assert view.elevation == 90.0
    assert view.turned(0.0, -900.0).elevation == -90.0
    assert View().zoomed(1e9).zoom == 20.0
    assert View().zoomed(0.0).zoom == 0.3
    for zoom in (0.3, 20.0):  # far outside the picture, and small in it
        drawn(square(0.0, [0.0, 1.0]), View(zoom=zoom), SIZE, BLACK, GREY, RED)
