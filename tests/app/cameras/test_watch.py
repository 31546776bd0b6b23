"""Frozen and black streams."""

import numpy as np
import pytest

from rotemina.app.cameras.frame_check import FrameCheck, PictureState
from rotemina.drivers.cameras.frame import Frame, Region


def frames(pictures, period_s=0.1, bits=8, noise_free=False):
    region = Region(0, 0, 40, 30)
    return [
        Frame(pixels, period_s * number, number, bits, region, noise_free=noise_free)
        for number, pixels in enumerate(pictures)
    ]


def noisy(count, level=100.0, seed=1, dtype=np.uint8, spread=3.0):
    rng = np.random.default_rng(seed)
    return [rng.normal(level, spread, (30, 40)).clip(0).astype(dtype) for _ in range(count)]


def judged(pictures, **kwargs):
    check = FrameCheck()
    return [check.judge(frame) for frame in frames(pictures, **kwargs)]


def test_a_live_stream():
    assert set(judged(noisy(30))) == {PictureState.LIVE}


def test_a_stream_that_freezes_and_recovers():
    live = noisy(3)
    shown = judged([*live, *[live[-1]] * 12, *noisy(2, seed=2)])
    first = shown.index(PictureState.FROZEN)
    assert first == 12  # a second after the last new one
    assert shown[-1] is PictureState.LIVE
    assert set(shown[first:15]) == {PictureState.FROZEN}


@pytest.mark.parametrize("buffers", [2, 3, 4, 16])
def test_a_driver_that_cycles_through_its_buffers_is_frozen(buffers):
    live = noisy(20)
    shown = judged([*live, *live[-buffers:] * 20, *noisy(2, seed=2)])
    first = shown.index(PictureState.FROZEN)
    assert first == 29  # a second after the last new one
    assert set(shown[first:-2]) == {PictureState.FROZEN}
    assert set(shown[-2:]) == {PictureState.LIVE}


def test_pictures_that_come_twice_each_are_alive():
    assert set(judged([one for one in noisy(20) for _ in range(2)])) == {PictureState.LIVE}


def test_equal_pictures_without_noise_are_alive():
    still = noisy(3)
    assert set(judged(still[:1] * 30, noise_free=True)) == {PictureState.LIVE}
    assert set(judged(still * 10, noise_free=True)) == {PictureState.LIVE}
    overexposed = np.full((30, 40), 255, np.uint8)
    assert set(judged([overexposed] * 30)) == {PictureState.LIVE}


def test_a_slow_stream_is_not_frozen_by_one_repetition():
    picture = noisy(1)[0]
    assert set(judged([picture] * 3, period_s=2.0)) == {PictureState.LIVE}


@pytest.mark.parametrize(("bits", "level", "dtype"), [(8, 2.0, np.uint8), (12, 45.0, np.uint16)])
def test_a_black_stream(bits, level, dtype):
    assert set(judged(noisy(5, level, dtype=dtype, spread=1.0), bits=bits)) == {PictureState.BLACK}


def test_a_dark_picture_with_something_in_it_is_not_black():
    pictures = noisy(5, 2.0)
    for picture in pictures:
        picture[::3, ::3] = 0
        picture[8:24, 8:24] = 90
    assert set(judged(pictures)) == {PictureState.LIVE}
