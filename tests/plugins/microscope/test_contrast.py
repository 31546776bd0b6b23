import numpy as np
import pytest

from rotemina.drivers.cameras.frame import Frame, Region
from rotemina.plugins.microscope.contrast import (
    Contrast,
    Table,
    as_rgb,
    histogram,
    levels,
    shown,
)


def frame(pixels, bits):
    rows, columns = pixels.shape[:2]
    return Frame(pixels, 0.0, 0, bits, Region(0, 0, columns, rows))


def grey_of(colours):
    rgb = as_rgb(colours)
    assert (rgb[..., 0] == rgb[..., 1]).all()
    assert (rgb[..., 0] == rgb[..., 2]).all()
    return rgb[..., 0].astype(int)


@pytest.mark.parametrize(("bits", "dtype"), [(8, np.uint8), (12, np.uint16), (16, np.uint16)])
@pytest.mark.parametrize("gamma", [1.0, 0.5, 2.2])
def test_every_number_is_shown_as_the_formula_has_it(bits, dtype, gamma):
    numbers = np.linspace(0, (1 << bits) - 1, 240).astype(dtype).reshape(12, 20)
    contrast = Contrast(auto=False, low=0.2, high=0.7, gamma=gamma)
    taken = frame(numbers, bits)
    share = (numbers / ((1 << bits) - 1) - 0.2) / 0.5
    expected = np.rint(255 * np.clip(share, 0, 1) ** gamma)
    seen = grey_of(shown(taken, contrast, levels(taken, contrast)))
    np.testing.assert_array_equal(seen, expected)
    inverted = Contrast(False, 0.2, 0.7, gamma, Table.INVERTED)
    seen = grey_of(shown(taken, inverted, levels(taken, inverted)))
    np.testing.assert_array_equal(seen, 255 - expected)


def test_levels_by_themselves_are_percentiles_and_never_meet():
    rng = np.random.default_rng(1)
    pixels = rng.normal(2000, 100, (400, 400)).clip(0, 4095).astype(np.uint16)
    low, high = levels(frame(pixels, 12), Contrast())
    assert low == pytest.approx((2000 - 309) / 4095, abs=5e-3)  # 0.1 % of a normal: 3.09 sigma
    assert high == pytest.approx((2000 + 309) / 4095, abs=5e-3)
    for value in (0, 4095):
        low, high = levels(frame(np.full((9, 9), value, np.uint16), 12), Contrast())
        assert 0.0 <= low < high


def test_saturated_pixels_are_red_also_where_the_picture_is_shrunk():
    pixels = np.full((100, 120), 500, np.uint16)
    pixels[37, 53] = pixels[99, 119] = 4095
    taken, contrast = frame(pixels, 12), Contrast(table=Table.SATURATED)
    for size in ((120, 100), (31, 17), (240, 200)):
        rgb = as_rgb(shown(taken, contrast, (0.0, 1.0), size=size)).astype(int)
        red = rgb[..., 0] > rgb[..., 1] + 100
        row, column = np.nonzero(red)
        assert red.sum() == (8 if size[0] == 240 else 2)
        assert row.min() == 37 * size[1] // 100
        assert column.min() == 53 * size[0] // 120
    plain = as_rgb(shown(taken, Contrast(), (0.0, 1.0)))
    assert (plain[37, 53] == 255).all()


def test_a_part_and_a_size_are_what_is_in_sight():
    pixels = np.arange(100 * 120, dtype=np.uint16).reshape(100, 120) % 4096
    taken, contrast = frame(pixels, 12), Contrast(auto=False)
    whole = shown(taken, contrast, (0.0, 1.0))
    part = shown(taken, contrast, (0.0, 1.0), columns=(10, 40), rows=(5, 25))
    np.testing.assert_array_equal(part, whole[5:25, 10:40])
    large = shown(taken, contrast, (0.0, 1.0), columns=(10, 40), rows=(5, 25), size=(90, 60))
    np.testing.assert_array_equal(large, part.repeat(3, axis=0).repeat(3, axis=1))


def test_colours():
    pixels = np.zeros((4, 5, 3), np.uint8)
    pixels[..., 0], pixels[..., 2] = 255, 51
    taken = frame(pixels, 8)
    rgb = as_rgb(shown(taken, Contrast(auto=False), (0.0, 1.0)))
    np.testing.assert_array_equal(rgb, pixels)
    viridis = Contrast(auto=False, table=Table.PERCEPTUAL)
    ramp = frame(np.array([[0, 4095]], np.uint16), 12)
    dark, bright = as_rgb(shown(ramp, viridis, (0.0, 1.0)))[0].astype(int)
    np.testing.assert_allclose(dark, [68, 1, 84], atol=1)  # the ends of viridis
    np.testing.assert_allclose(bright, [253, 231, 37], atol=2)


@pytest.mark.parametrize("bits", [8, 12, 16])
def test_the_histogram_counts_every_sampled_pixel(bits):
    dtype = np.uint8 if bits == 8 else np.uint16
    pixels = np.zeros((40, 40), dtype)
    pixels[:20] = (1 << bits) - 1
    counts = histogram(frame(pixels, bits))
    assert counts.shape == (256,)
    assert (counts[0], counts[255], counts.sum()) == (50, 50, 100)
