"""Whole images: the shift is found to a few hundredths, or refused with the reason."""

import numpy as np
import pytest
from scipy import ndimage

from rotemina.sim.vision.background_drift import background_drift
from rotemina.sim.vision.errors import RegistrationError, VisionError
from rotemina.sim.vision.image import grey, noise_rms, relative_to
from rotemina.sim.vision.registration import register

ROWS, COLUMNS, EDGE = 300, 380, 80


class Scenery:
    """A texture much larger than the picture, under a lamp that falls off."""

    def __init__(self, seed=0):
        self.rng = np.random.default_rng(seed)
        field = self.rng.standard_normal((ROWS + 2 * EDGE, COLUMNS + 2 * EDGE))
        field = ndimage.gaussian_filter(field, 2.5)
        self.field = field / field.std()

    def seen(self, shift=(0.0, 0.0), noise=15.0, contrast=60.0):
        moved = ndimage.shift(self.field, shift[::-1], order=5, mode="wrap")
        moved = moved[EDGE:-EDGE, EDGE:-EDGE]
        row, column = np.mgrid[-1 : 1 : ROWS * 1j, -1 : 1 : COLUMNS * 1j]
        lamp = 1.0 - 0.2 * (row**2 + column**2)
        light = (1000.0 + contrast * moved) * lamp
        return grey(light + noise * self.rng.standard_normal(light.shape))


@pytest.fixture
def scenery():
    return Scenery()


@pytest.mark.parametrize("shift", [(0.0, 0.0), (0.3, -0.7), (-21.5, 12.25), (60.4, 40.8)])
def test_a_shift_is_found_to_a_few_hundredths_of_a_pixel(scenery, shift):
    found = register(scenery.seen(), scenery.seen(shift))
    assert found.shift == pytest.approx(shift, abs=0.06)
    assert np.abs(found.shift - shift).max() < 4.0 * np.sqrt(found.covariance.diagonal().max())
    assert found.correlation > 0.9


def test_vignetting_and_dust_that_stay_do_not_hold_the_picture(scenery):
    found = register(scenery.seen(contrast=25.0), scenery.seen((15.0, 8.0), contrast=25.0))
    assert found.shift == pytest.approx([15.0, 8.0], abs=0.15)


def test_noise_alone_is_refused(scenery):
    with pytest.raises(RegistrationError, match="share too little detail"):
        register(scenery.seen(contrast=0.0), scenery.seen(contrast=0.0))


def test_a_grating_is_refused():
    rng = np.random.default_rng(1)

    def seen(shift):
        column = np.mgrid[:ROWS, :COLUMNS][1] - shift
        bars = 200.0 * (np.sin(2.0 * np.pi * column / 20.0) > 0.0)
        return grey(1000.0 + bars + 15.0 * rng.standard_normal(bars.shape))

    with pytest.raises(RegistrationError, match="repeat"):
        register(seen(0), seen(5))


def test_images_of_two_sizes_are_refused(scenery):
    image = scenery.seen()
    with pytest.raises(RegistrationError, match="380 × 300 px"):
        register(image, image[:-10])


def test_what_is_no_picture_is_refused():
    with pytest.raises(VisionError, match="every pixel is 0"):
        grey(np.zeros((64, 64), dtype=np.uint16))
    with pytest.raises(VisionError, match="every pixel is 4095"):
        grey(np.full((64, 64), 4095, dtype=np.uint16))
    with pytest.raises(VisionError, match="finite"):
        grey(np.full((64, 64), np.nan))
    with pytest.raises(VisionError, match="shape"):
        grey(np.zeros((4, 4)))
    with pytest.raises(VisionError, match="take it again"):
        relative_to(np.ones((64, 64), np.float32), np.ones((32, 64), np.float32))


def test_colour_becomes_one_plane():
    image = np.zeros((20, 20, 3), dtype=np.uint8)
    image[5, 5] = 255
    assert grey(image)[5, 5] == pytest.approx(255.0)


def test_noise_is_measured_beside_detail(scenery):
    assert noise_rms(scenery.seen(noise=15.0)) == pytest.approx(15.0, rel=0.1)


def test_the_background_drifts_while_something_else_moves_on(scenery):
    first, second = scenery.seen(), scenery.seen((2.3, -1.4)).copy()
    second[100:180, :100] = 300.0  # what covers a part of it
    drift = background_drift(first, second)
    assert drift.shift == pytest.approx([2.3, -1.4], abs=0.1)


def test_a_background_without_detail_has_no_drift_that_could_be_told(scenery):
    with pytest.raises(RegistrationError, match="parts of the picture agree"):
        background_drift(scenery.seen(contrast=0.0), scenery.seen(contrast=0.0))
