"""Frozen buffers below every kind of camera, and pictures that may repeat."""

import numpy as np
import pytest
from tests.drivers.cameras.camera_benches import BENCHES, PluginSource, write_sequence

from rotemina.app.cameras.frame_check import FrameCheck, PictureState
from rotemina.drivers.cameras.sequence import ImageSequences
from rotemina.drivers.clock import VirtualClock

FILES = ("film_bench", "sequence_bench")


@pytest.fixture
def clock():
    return VirtualClock(1234.5)


def states(camera, clock, lasts_s=2.5):
    """Return what pictures of so long show."""
    check, found, until_s = FrameCheck(), [], clock() + lasts_s
    while clock() < until_s:
        clock.advance(0.02)
        frame = camera.grab(0.5)
        if frame is not None:
            found.append(check.judge(frame))
    return found


@pytest.mark.parametrize("buffers", [1, 2, 3, 4])
@pytest.mark.parametrize("make", BENCHES, ids=lambda make: make.__name__)
def test_frozen_buffers_are_noticed_unless_it_is_a_file(
    make, buffers, clock, tmp_path, monkeypatch
):
    bench = make(clock, tmp_path, monkeypatch)
    bench.camera.open()
    pixels = bench.camera.grab(0.5).pixels
    bench.tap.freeze(pixels, buffers)
    found = states(bench.camera, clock)
    frozen = make.__name__ not in FILES
    assert (PictureState.FROZEN in found) == frozen
    assert found[-1] is (PictureState.FROZEN if frozen else PictureState.LIVE)
    bench.tap.buffers = []
    bench.camera.close()


def test_a_sequence_of_equal_files_is_alive(clock, tmp_path):
    folder = write_sequence(tmp_path / "equal", [30_000])
    for name in ("1.png", "2.png", "3.png"):
        (folder / name).write_bytes((folder / "30000.png").read_bytes())
    source = ImageSequences(clock=clock, wait=clock.advance)
    camera = source.camera(source.addressed(str(folder)))
    camera.open()
    assert set(states(camera, clock)) == {PictureState.LIVE}


def test_a_drawn_scene_at_rest_is_alive(clock):
    scene = np.random.default_rng(1).integers(50, 200, (48, 64)).astype(np.uint8)
    source = PluginSource(lambda: scene, noise_free=True, clock=clock, wait=clock.advance)
    camera = source.camera(source.devices()[0])
    camera.open()
    assert set(states(camera, clock)) == {PictureState.LIVE}
