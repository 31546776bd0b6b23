"""What tests of cameras share: each kind of camera, and fakes of what lies below it."""

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
def write_film():
    return camera_benches.write_film


@pytest.fixture
def write_sequence(tmp_path):
    return partial(camera_benches.write_sequence, tmp_path / "sequence")


@pytest.fixture(params=BENCHES, ids=lambda make: make.__name__)
def bench(request, clock, tmp_path, monkeypatch):
    make = request.param
    make = getattr(camera_benches, make) if isinstance(make, str) else make
    return make(clock, tmp_path, monkeypatch)


@pytest.fixture
def camera(bench):
    bench.camera.open()
    yield bench.camera
    bench.camera.close()
