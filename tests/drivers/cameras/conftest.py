"""Fixtures for tests of cameras: each kind of camera, and fakes of the libraries."""

from functools import partial

import pytest
from tests.drivers.cameras import camera_benches
from tests.drivers.cameras.camera_benches import BENCHES, FakeCapture, FakeCore


@pytest.fixture
def capture():
    return FakeCapture()


@pytest.fixture
def core():
    return FakeCore()


@pytest.fixture
def write_video():
    return camera_benches.write_video


@pytest.fixture
def write_sequence(tmp_path):
    return partial(camera_benches.write_sequence, tmp_path / "sequence")


@pytest.fixture(params=BENCHES, ids=lambda make_bench: make_bench.__name__)
def bench(request, clock, tmp_path, monkeypatch):
    make_bench = request.param
    if isinstance(make_bench, str):
        make_bench = getattr(camera_benches, make_bench)
    return make_bench(clock, tmp_path, monkeypatch)


@pytest.fixture
def camera(bench):
    bench.camera.open()
    yield bench.camera
    bench.camera.close()
