"""Registration of images: the shift is found to a few hundredths of a pixel, or refused."""

import numpy as np
import pytest
from scipy import ndimage

from rotemina.sim.errors import RegistrationError, VisionError
from rotemina.sim.vision import (
    divide_by_background,
    measure_background_drift,
    register_images,
    to_grey,
)
from rotemina.sim.vision.image import estimate_noise_rms

ROWS, COLUMNS, EDGE = 300, 380, 80


class TexturedScene:
    """A texture that is larger than the image, with vignetting."""

    def __init__(self, seed=0):
        self.rng = np.random.default_rng(seed)
        field = self.rng.standard_normal((ROWS + 2 * EDGE, COLUMNS + 2 * EDGE))
        field = ndimage.gaussian_filter(field, 2.5)
        self.field = field / field.std()

    def take_image(self, shift=(0.0, 0.0), noise=15.0, contrast=60.0):
        texture = ndimage.shift(self.field, shift[::-1], order=5, mode="wrap")
        texture = texture[EDGE:-EDGE, EDGE:-EDGE]
        row, column = np.mgrid[-1 : 1 : ROWS * 1j, -1 : 1 : COLUMNS * 1j]
        illumination = 1.0 - 0.2 * (row**2 + column**2)
        light = (1000.0 + contrast * texture) * illumination
        return to_grey(light + noise * self.rng.standard_normal(light.shape))


@pytest.fixture
def scenery():
    return TexturedScene()


@pytest.mark.parametrize("shift", [(0.0, 0.0), (0.3, -0.7), (-21.5, 12.25), (60.4, 40.8)])
def test_a_shift_is_found_within_0_06_pixels(scenery, shift):
    registration = register_images(scenery.take_image(), scenery.take_image(shift))
    assert registration.shift == pytest.approx(shift, abs=0.06)
    assert np.abs(registration.shift - shift).max() < 4.0 * np.sqrt(
        registration.covariance.diagonal().max()
    )
    assert registration.correlation > 0.9


def test_constant_vignetting_does_not_affect_the_shift(scenery):
    registration = register_images(
        scenery.take_image(contrast=25.0), scenery.take_image((15.0, 8.0), contrast=25.0)
    )
    assert registration.shift == pytest.approx([15.0, 8.0], abs=0.15)


def test_images_with_only_noise_are_refused(scenery):
    with pytest.raises(RegistrationError, match="share too little detail"):
        register_images(scenery.take_image(contrast=0.0), scenery.take_image(contrast=0.0))


def test_a_grating_is_refused():
    rng = np.random.default_rng(1)

    def take_image(shift):
        column = np.mgrid[:ROWS, :COLUMNS][1] - shift
        bars = 200.0 * (np.sin(2.0 * np.pi * column / 20.0) > 0.0)
        return to_grey(1000.0 + bars + 15.0 * rng.standard_normal(bars.shape))

    with pytest.raises(RegistrationError, match="repeat"):
        register_images(take_image(0), take_image(5))


def test_images_of_different_sizes_are_refused(scenery):
    image = scenery.take_image()
    with pytest.raises(RegistrationError, match="380 × 300 px"):
        register_images(image, image[:-10])


def test_invalid_images_are_refused():
    with pytest.raises(VisionError, match="every pixel is 0"):
        to_grey(np.zeros((64, 64), dtype=np.uint16))
    with pytest.raises(VisionError, match="every pixel is 4095"):
        to_grey(np.full((64, 64), 4095, dtype=np.uint16))
    with pytest.raises(VisionError, match="finite"):
        to_grey(np.full((64, 64), np.nan))
    with pytest.raises(VisionError, match="shape"):
        to_grey(np.zeros((4, 4)))
    with pytest.raises(VisionError, match="take it again"):
        divide_by_background(np.ones((64, 64), np.float32), np.ones((32, 64), np.float32))


def test_a_colour_image_becomes_grey():
    image = np.zeros((20, 20, 3), dtype=np.uint8)
    image[5, 5] = 255
    assert to_grey(image)[5, 5] == pytest.approx(255.0)


def test_noise_is_estimated_despite_detail(scenery):
    assert estimate_noise_rms(scenery.take_image(noise=15.0)) == pytest.approx(15.0, rel=0.1)


def test_the_drift_of_the_background_is_measured_despite_a_moving_object(scenery):
    first, second = scenery.take_image(), scenery.take_image((2.3, -1.4)).copy()
    second[100:180, :100] = 300.0  # an object that covers a part of the image
    drift = measure_background_drift(first, second)
    assert drift.shift == pytest.approx([2.3, -1.4], abs=0.1)


def test_the_drift_of_a_background_without_detail_is_refused(scenery):
    with pytest.raises(RegistrationError, match="parts of the picture agree"):
        measure_background_drift(scenery.take_image(contrast=0.0), scenery.take_image(contrast=0.0))
