"""The last camera reopens at the next start with its settings, or is reported as missing."""

from types import SimpleNamespace

import pytest

from rotemina.app.cameras import FeedState, FeedView
from rotemina.app.microscope.camera_in_use import CameraInUse
from rotemina.app.microscope.camera_memory import LAST_CAMERA_KEY, CameraMemory
from rotemina.app.settings import UserSettings
from rotemina.drivers.cameras import (
    CameraHub,
    CameraIdentity,
    CameraSettings,
    CameraSource,
    CameraTrigger,
    PixelType,
    SensorRegion,
)
from rotemina.drivers.simulator import Simulator
from rotemina.sim.robot_files import load_robot

SETTINGS = CameraSettings(
    exposure_s=0.02,
    region=SensorRegion(8, 4, 64, 48),
    pixel_type=PixelType.MONO8,
    trigger=CameraTrigger.FREE,
)


class FakeSource(CameraSource):
    """A source whose cameras the test plugs in and out. They have only an identity."""

    def __init__(self, name, *addresses):
        super().__init__(clock=lambda: 0.0)
        self.name, self.addresses, self.fault = name, list(addresses), None

    @property
    def problem(self):
        return self.fault

    def devices(self):
        return [CameraIdentity(f"{self.name}:{address}", f"Eye {address}", self.name)
                for address in self.addresses]  # fmt: skip

    def parse_address(self, address):
        return CameraIdentity(f"{self.name}:{address}", address, self.name)

    def camera(self, identity):
        return SimpleNamespace(identity=identity)


class FakeFeed:
    """A feed that shows a picture as soon as it runs."""

    def __init__(self, camera):
        self.camera, self.view = camera, FeedView()

    def start(self, settings=None):
        self.configure(settings or CameraSettings())

    def configure(self, settings):
        self.view = FeedView(FeedState.LIVE, frame=object(), settings=settings)

    def close(self):
        self.view = FeedView()


@pytest.fixture
def restart(tmp_path):
    """Function that restarts the program with cameras of the source ``fake`` and steps once."""

    def start(*addresses, simulator=True):
        source, driver = FakeSource("fake", *addresses), None
        if simulator:
            driver = Simulator(load_robot("rotemina"), clock=lambda: 0.0)
        hub = CameraHub({"fake": source, "simulated": FakeSource("simulated", "microscope")})
        memory = CameraMemory(UserSettings(tmp_path / "settings.json"))
        camera_in_use = CameraInUse(hub, lambda: camera_in_use.driver, FakeFeed, memory)
        camera_in_use.is_watched = True
        camera_in_use.source, camera_in_use.driver, camera_in_use.hub = source, driver, hub
        camera_in_use.step(0.0)
        return camera_in_use

    return start


def test_last_camera_reopens_with_its_settings(restart):
    first = restart("a", "b")
    assert first.camera.identity.key == "simulated:microscope"
    first.open("fake:b")
    first.step(0.1)
    first.configure(SETTINGS)
    first.step(0.2)
    first.close()
    second = restart("b", "c")
    assert second.camera.identity.key == "fake:b"
    assert second.view.settings == SETTINGS


def test_missing_camera_is_reported_and_opens_when_it_is_back(restart):
    first = restart("a")
    first.open("fake:a", SETTINGS)
    first.step(0.1)
    second = restart()
    assert second.camera is None
    assert second.view.state is FeedState.LOST
    assert second.view.reason == (
        "Eye a (fake:a), the camera used last, is not connected; plug it in, or choose another"
    )
    second.source.addresses.append("a")
    second.step(10.0)
    assert second.camera.identity.key == "fake:a"
    assert second.view.settings == SETTINGS
    third = restart()
    third.open("simulated:microscope")
    third.step(0.1)
    third.source.addresses.append("a")
    third.step(10.0)
    assert third.camera.identity.key == "simulated:microscope"


def test_unlisted_camera_reopens_by_its_address(restart):
    first = restart()
    first.open_address("fake", "film.avi")
    first.step(0.1)
    assert restart().camera.identity.key == "fake:film.avi"


def test_simulated_camera_keeps_its_settings_and_needs_a_simulator(restart):
    first = restart()
    first.configure(SETTINGS)
    first.step(0.1)
    assert restart().view.settings == SETTINGS
    assert restart(simulator=False).camera is None


@pytest.mark.parametrize("is_chosen", [True, False])
def test_simulated_camera_reopens_with_a_simulator(restart, is_chosen):
    camera_in_use = restart()
    if is_chosen:
        camera_in_use.open("simulated:microscope", SETTINGS)
        camera_in_use.step(0.1)
    simulator, settings = camera_in_use.driver, camera_in_use.view.settings
    for at_s, name in ((10.0, "mc68hc11"), (20.0, "gcode")):
        camera_in_use.driver = SimpleNamespace(name=name)
        camera_in_use.hub.sources["simulated"].fault = f"{name} shows only a simulated machine"
        camera_in_use.step(at_s)
        assert camera_in_use.view.state is FeedState.LOST
        assert camera_in_use.view.reason == f"{name} shows only a simulated machine"
    camera_in_use.driver, camera_in_use.hub.sources["simulated"].fault = simulator, None
    camera_in_use.step(30.0)
    assert camera_in_use.camera.identity.key == "simulated:microscope"
    assert (camera_in_use.view.state, camera_in_use.view.settings) == (FeedState.LIVE, settings)


def test_lost_simulated_camera_reopens_with_a_new_simulator(restart):
    camera_in_use = restart()
    camera_in_use.step(10.0)
    camera_in_use._feed.view = FeedView(FeedState.LOST, "there is no simulated machine")
    camera_in_use.driver = Simulator(load_robot("rotemina"), clock=lambda: 0.0)  # between two steps
    camera_in_use.step(20.0)
    assert camera_in_use.view.state is FeedState.LIVE
    camera_in_use._feed.view = FeedView(FeedState.LOST, "something else")
    camera_in_use.step(30.0)
    assert camera_in_use.view.reason == "something else"  # same machine: it is not reopened forever


def test_chosen_camera_replaces_the_simulated_one_permanently(restart):
    camera_in_use = restart("a")
    simulator = camera_in_use.driver
    camera_in_use.driver = SimpleNamespace(name="mc68hc11")
    camera_in_use.step(10.0)
    camera_in_use.open("fake:a")
    camera_in_use.step(20.0)
    camera_in_use.driver = simulator
    camera_in_use.step(30.0)
    assert camera_in_use.camera.identity.key == "fake:a"


def test_closed_camera_is_forgotten(restart):
    first = restart("a")
    first.open("fake:a")
    first.step(0.1)
    first.close_and_forget()
    first.step(0.2)
    assert restart("a").camera.identity.key == "simulated:microscope"


@pytest.mark.parametrize("text", ["{", '{"identity": 3}', '{"settings": {"gain": "much"}}'])
def test_invalid_preference_is_ignored(tmp_path, text, caplog):
    settings = UserSettings(tmp_path / "settings.json")
    settings.set(LAST_CAMERA_KEY, text)
    assert CameraMemory(settings).last_camera is None
    assert "microscope.camera is ignored" in caplog.text
