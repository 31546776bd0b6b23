"""Frozen buffers of every kind of camera, and sources whose pictures may repeat."""

import numpy as np
import pytest
from tests.drivers.cameras.camera_benches import BENCHES, PluginSource, write_sequence

from rotemina.app.cameras import FrameCheck, PictureState
from rotemina.drivers.cameras.sequence import ImageSequenceSource
from rotemina.drivers.contract import VirtualClock

FILE_BENCHES = ("film_bench", "sequence_bench")


@pytest.fixture
def clock():
    return VirtualClock(1234.5)


def classify_frames(camera, clock, duration_s=2.5):
    """Return the states of the frames over ``duration_s``."""
    check, states, until_s = FrameCheck(), [], clock() + duration_s
    while clock() < until_s:
        clock.advance(0.02)
        frame = camera.grab(0.5)
        if frame is not None:
            states.append(check.classify(frame))
    return states


@pytest.mark.parametrize("buffers", [1, 4])
@pytest.mark.parametrize("make_bench", BENCHES, ids=lambda make_bench: make_bench.__name__)
def test_frozen_buffers_are_detected_except_for_files(
    make_bench, buffers, clock, tmp_path, monkeypatch
):
    bench = make_bench(clock, tmp_path, monkeypatch)
    bench.camera.open()
    pixels = bench.camera.grab(0.5).pixels
    bench.tap.freeze(pixels, buffers)
    states = classify_frames(bench.camera, clock)
    is_frozen = make_bench.__name__ not in FILE_BENCHES
    assert (PictureState.FROZEN in states) == is_frozen
    assert states[-1] is (PictureState.FROZEN if is_frozen else PictureState.LIVE)
    bench.tap.buffers = []
    bench.camera.close()


def test_sequence_of_equal_files_is_live(clock, tmp_path):
    folder = write_sequence(tmp_path / "equal", [30_000])
    for name in ("1.png", "2.png", "3.png"):
        (folder / name).write_bytes((folder / "30000.png").read_bytes())
    source = ImageSequenceSource(clock=clock, wait=clock.advance)
    camera = source.camera(source.parse_address(str(folder)))
    camera.open()
    assert set(classify_frames(camera, clock)) == {PictureState.LIVE}


def test_rendered_scene_at_rest_is_live(clock):
    scene = np.random.default_rng(1).integers(50, 200, (48, 64)).astype(np.uint8)
    source = PluginSource(lambda: scene, noise_free=True, clock=clock, wait=clock.advance)
    camera = source.camera(source.devices()[0])
    camera.open()
    assert set(classify_frames(camera, clock)) == {PictureState.LIVE}
