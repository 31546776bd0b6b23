import numpy as np
import pytest

from rotemina.drivers.cameras import CameraFrame, SensorRegion
from rotemina.plugins.microscope.contrast import (
    ColourTable,
    ContrastSettings,
    compute_histogram,
    compute_levels,
    render_frame,
    to_rgb,
)


def make_frame(pixels, bits):
    rows, columns = pixels.shape[:2]
    return CameraFrame(pixels, 0.0, 0, bits, SensorRegion(0, 0, columns, rows))


def extract_grey(colours):
    rgb = to_rgb(colours)
    assert (rgb[..., 0] == rgb[..., 1]).all()
    assert (rgb[..., 0] == rgb[..., 2]).all()
    return rgb[..., 0].astype(int)


@pytest.mark.parametrize(("bits", "dtype"), [(8, np.uint8), (12, np.uint16), (16, np.uint16)])
@pytest.mark.parametrize("gamma", [1.0, 2.2])
def test_every_value_is_rendered_by_the_contrast_formula(bits, dtype, gamma):
    values = np.linspace(0, (1 << bits) - 1, 240).astype(dtype).reshape(12, 20)
    contrast = ContrastSettings(auto=False, low=0.2, high=0.7, gamma=gamma)
    frame = make_frame(values, bits)
    share = (values / ((1 << bits) - 1) - 0.2) / 0.5
    expected = np.rint(255 * np.clip(share, 0, 1) ** gamma)
    grey = extract_grey(render_frame(frame, contrast, compute_levels(frame, contrast)))
    np.testing.assert_array_equal(grey, expected)
    inverted = ContrastSettings(False, 0.2, 0.7, gamma, ColourTable.INVERTED)
    grey = extract_grey(render_frame(frame, inverted, compute_levels(frame, inverted)))
    np.testing.assert_array_equal(grey, 255 - expected)


def test_automatic_levels_are_distinct_percentiles():
    rng = np.random.default_rng(1)
    pixels = rng.normal(2000, 100, (400, 400)).clip(0, 4095).astype(np.uint16)
    low, high = compute_levels(make_frame(pixels, 12), ContrastSettings())
    # The levels are the 0.1 % quantiles, at 3.09 standard deviations.
    assert low == pytest.approx((2000 - 309) / 4095, abs=5e-3)
    assert high == pytest.approx((2000 + 309) / 4095, abs=5e-3)
    for value in (0, 4095):
        low, high = compute_levels(
            make_frame(np.full((9, 9), value, np.uint16), 12), ContrastSettings()
        )
        assert 0.0 <= low < high


def test_saturated_pixels_are_red_at_every_size():
    pixels = np.full((100, 120), 500, np.uint16)
    pixels[37, 53] = pixels[99, 119] = 4095
    frame, contrast = make_frame(pixels, 12), ContrastSettings(table=ColourTable.SATURATED)
    for size in ((120, 100), (31, 17), (240, 200)):
        rgb = to_rgb(render_frame(frame, contrast, (0.0, 1.0), size=size)).astype(int)
        red = rgb[..., 0] > rgb[..., 1] + 100
        row, column = np.nonzero(red)
        assert red.sum() == (8 if size[0] == 240 else 2)
        assert row.min() == 37 * size[1] // 100
        assert column.min() == 53 * size[0] // 120
    plain = to_rgb(render_frame(frame, ContrastSettings(), (0.0, 1.0)))
    assert (plain[37, 53] == 255).all()


def test_a_part_is_rendered_at_a_given_size():
    pixels = np.arange(100 * 120, dtype=np.uint16).reshape(100, 120) % 4096
    frame, contrast = make_frame(pixels, 12), ContrastSettings(auto=False)
    whole = render_frame(frame, contrast, (0.0, 1.0))
    part = render_frame(frame, contrast, (0.0, 1.0), columns=(10, 40), rows=(5, 25))
    np.testing.assert_array_equal(part, whole[5:25, 10:40])
    large = render_frame(frame, contrast, (0.0, 1.0), columns=(10, 40), rows=(5, 25), size=(90, 60))
    np.testing.assert_array_equal(large, part.repeat(3, axis=0).repeat(3, axis=1))


def test_colour_pictures_and_colour_tables():
    pixels = np.zeros((4, 5, 3), np.uint8)
    pixels[..., 0], pixels[..., 2] = 255, 51
    frame = make_frame(pixels, 8)
    rgb = to_rgb(render_frame(frame, ContrastSettings(auto=False), (0.0, 1.0)))
    np.testing.assert_array_equal(rgb, pixels)
    viridis = ContrastSettings(auto=False, table=ColourTable.PERCEPTUAL)
    ramp = make_frame(np.array([[0, 4095]], np.uint16), 12)
    dark, bright = to_rgb(render_frame(ramp, viridis, (0.0, 1.0)))[0].astype(int)
    np.testing.assert_allclose(dark, [68, 1, 84], atol=1)  # the two end colours of viridis
    np.testing.assert_allclose(bright, [253, 231, 37], atol=2)


@pytest.mark.parametrize("bits", [8, 16])
def test_the_histogram_counts_every_sampled_pixel(bits):
    dtype = np.uint8 if bits == 8 else np.uint16
    pixels = np.zeros((40, 40), dtype)
    pixels[:20] = (1 << bits) - 1
    counts = compute_histogram(make_frame(pixels, bits))
    assert counts.shape == (256,)
    assert (counts[0], counts[255], counts.sum()) == (50, 50, 100)
