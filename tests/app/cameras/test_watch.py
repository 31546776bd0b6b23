"""Detection of frozen and black streams."""

import numpy as np
import pytest

from rotemina.app.cameras import FrameCheck, PictureState
from rotemina.drivers.cameras import CameraFrame, SensorRegion


def make_frames(pictures, period_s=0.1, bits=8, noise_free=False):
    region = SensorRegion(0, 0, 40, 30)
    return [
        CameraFrame(pixels, period_s * number, number, bits, region, noise_free=noise_free)
        for number, pixels in enumerate(pictures)
    ]


def make_noisy_pictures(count, level=100.0, seed=1, dtype=np.uint8, spread=3.0):
    rng = np.random.default_rng(seed)
    return [rng.normal(level, spread, (30, 40)).clip(0).astype(dtype) for _ in range(count)]


def classify_pictures(pictures, **kwargs):
    check = FrameCheck()
    return [check.classify(frame) for frame in make_frames(pictures, **kwargs)]


@pytest.mark.parametrize("buffers", [1, 2, 16])
def test_driver_that_cycles_through_its_buffers_is_frozen(buffers):
    live = make_noisy_pictures(20)
    states = classify_pictures([*live, *live[-buffers:] * 20, *make_noisy_pictures(2, seed=2)])
    assert set(states[:20]) == {PictureState.LIVE}
    first = states.index(PictureState.FROZEN)
    assert first == 29  # one second after the last new picture
    assert set(states[first:-2]) == {PictureState.FROZEN}
    assert set(states[-2:]) == {PictureState.LIVE}


def test_pictures_that_come_twice_each_are_live():
    assert set(
        classify_pictures([picture for picture in make_noisy_pictures(20) for _ in range(2)])
    ) == {PictureState.LIVE}


def test_equal_noise_free_pictures_are_live():
    pictures = make_noisy_pictures(3)
    assert set(classify_pictures(pictures[:1] * 30, noise_free=True)) == {PictureState.LIVE}
    assert set(classify_pictures(pictures * 10, noise_free=True)) == {PictureState.LIVE}
    overexposed = np.full((30, 40), 255, np.uint8)
    assert set(classify_pictures([overexposed] * 30)) == {PictureState.LIVE}


def test_a_slow_stream_is_not_frozen_by_one_repetition():
    picture = make_noisy_pictures(1)[0]
    assert set(classify_pictures([picture] * 3, period_s=2.0)) == {PictureState.LIVE}


@pytest.mark.parametrize(("bits", "level", "dtype"), [(8, 2.0, np.uint8), (12, 45.0, np.uint16)])
def test_dark_stream_is_black(bits, level, dtype):
    assert set(
        classify_pictures(make_noisy_pictures(5, level, dtype=dtype, spread=1.0), bits=bits)
    ) == {PictureState.BLACK}


def test_dark_picture_with_an_object_is_not_black():
    pictures = make_noisy_pictures(5, 2.0)
    for picture in pictures:
        picture[::3, ::3] = 0
        picture[8:24, 8:24] = 90
    assert set(classify_pictures(pictures)) == {PictureState.LIVE}
