"""The camera in use comes back at the next start, with its settings, or is said to be gone."""

from types import SimpleNamespace

import pytest

from rotemina.app.cameras.feed import FeedState, FeedView
from rotemina.app.microscope.camera_in_use import CameraInUse
from rotemina.app.microscope.camera_memory import KEY, CameraMemory
from rotemina.app.settings import Settings
from rotemina.drivers.cameras.camera import CameraIdentity
from rotemina.drivers.cameras.frame import Region
from rotemina.drivers.cameras.hub import CameraHub
from rotemina.drivers.cameras.settings import CameraSettings, PixelType, Trigger
from rotemina.drivers.cameras.source import CameraSource
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.robot.file import load_robot

SET = CameraSettings(
    exposure_s=0.02, region=Region(8, 4, 64, 48), pixel_type=PixelType.MONO8, trigger=Trigger.FREE
)


class Source(CameraSource):
    """Its cameras are plugged in and out by the test, and are nothing but their identity."""

    def __init__(self, name, *addresses):
        super().__init__(clock=lambda: 0.0)
        self.name, self.addresses, self.trouble = name, list(addresses), None

    @property
    def problem(self):
        return self.trouble

    def devices(self):
        return [CameraIdentity(f"{self.name}:{one}", f"Eye {one}", self.name)
                for one in self.addresses]  # fmt: skip

    def addressed(self, address):
        return CameraIdentity(f"{self.name}:{address}", address, self.name)

    def camera(self, identity):
        return SimpleNamespace(identity=identity)


class Feed:
    """Shows a picture as soon as it runs."""

    def __init__(self, camera):
        self.camera, self.view = camera, FeedView()

    def start(self, settings=None):
        self.configure(settings or CameraSettings())

    def configure(self, settings):
        self.view = FeedView(FeedState.LIVE, frame=object(), settings=settings)

    def close(self):
        self.view = FeedView()


@pytest.fixture
def used(tmp_path):
    """Return what starts anew with the cameras of ``fake``, and steps once."""

    def start(*addresses, simulator=True):
        source, driver = Source("fake", *addresses), None
        if simulator:
            driver = Simulator(load_robot("rotemina"), clock=lambda: 0.0)
        hub = CameraHub({"fake": source, "simulated": Source("simulated", "microscope")})
        memory = CameraMemory(Settings(tmp_path / "settings.json"))
        made = CameraInUse(hub, lambda: made.driver, Feed, memory)
        made.watched, made.source, made.driver, made.hub = True, source, driver, hub
        made.step(0.0)
        return made

    return start


def test_the_camera_used_last_comes_back_with_its_settings(used):
    first = used("a", "b")
    assert first.camera.identity.key == "simulated:microscope"
    first.open("fake:b")
    first.step(0.1)
    first.configure(SET)
    first.step(0.2)
    first.close()
    again = used("b", "c")
    assert again.camera.identity.key == "fake:b"
    assert again.view.settings == SET


def test_one_that_is_gone_is_said_and_opens_when_it_is_back(used):
    first = used("a")
    first.open("fake:a", SET)
    first.step(0.1)
    gone = used()
    assert gone.camera is None
    assert gone.view.state is FeedState.LOST
    assert gone.view.reason == (
        "Eye a (fake:a), the camera used last, is not connected; plug it in, or choose another"
    )
    gone.source.addresses.append("a")
    gone.step(10.0)
    assert gone.camera.identity.key == "fake:a"
    assert gone.view.settings == SET
    other = used()
    other.open("simulated:microscope")
    other.step(0.1)
    other.source.addresses.append("a")
    other.step(10.0)
    assert other.camera.identity.key == "simulated:microscope"


def test_what_no_list_shows_comes_back_by_its_address(used):
    first = used()
    first.open_address("fake", "film.avi")
    first.step(0.1)
    assert used().camera.identity.key == "fake:film.avi"


def test_the_simulated_one_keeps_its_settings_and_shows_no_other_machine(used):
    first = used()
    first.configure(SET)
    first.step(0.1)
    assert used().view.settings == SET
    assert used(simulator=False).camera is None


@pytest.mark.parametrize("is_chosen", [True, False])
def test_the_simulated_one_comes_back_with_a_simulator(used, is_chosen):
    seen = used()
    if is_chosen:
        seen.open("simulated:microscope", SET)
        seen.step(0.1)
    simulator, settings = seen.driver, seen.view.settings
    for at_s, name in ((10.0, "mc68hc11"), (20.0, "gcode")):
        seen.driver = SimpleNamespace(name=name)
        seen.hub.sources["simulated"].trouble = f"{name} shows only a simulated machine"
        seen.step(at_s)
        assert seen.view.state is FeedState.LOST
        assert seen.view.reason == f"{name} shows only a simulated machine"
    seen.driver, seen.hub.sources["simulated"].trouble = simulator, None
    seen.step(30.0)
    assert seen.camera.identity.key == "simulated:microscope"
    assert (seen.view.state, seen.view.settings) == (FeedState.LIVE, settings)


def test_a_simulated_picture_that_was_lost_meanwhile_comes_back(used):
    seen = used()
    seen.step(10.0)
    seen._feed.view = FeedView(FeedState.LOST, "there is no simulated machine")
    seen.driver = Simulator(load_robot("rotemina"), clock=lambda: 0.0)  # between two looks
    seen.step(20.0)
    assert seen.view.state is FeedState.LIVE
    seen._feed.view = FeedView(FeedState.LOST, "something else")
    seen.step(30.0)
    assert seen.view.reason == "something else"  # no other machine: it is not tried for ever


def test_another_camera_takes_the_place_of_the_simulated_one_for_good(used):
    seen = used("a")
    simulator = seen.driver
    seen.driver = SimpleNamespace(name="mc68hc11")
    seen.step(10.0)
    seen.open("fake:a")
    seen.step(20.0)
    seen.driver = simulator
    seen.step(30.0)
    assert seen.camera.identity.key == "fake:a"


def test_who_closed_it_is_asked_anew(used):
    first = used("a")
    first.open("fake:a")
    first.step(0.1)
    first.close_and_forget()
    first.step(0.2)
    assert used("a").camera.identity.key == "simulated:microscope"


@pytest.mark.parametrize("text", ["{", '{"identity": 3}', "[]", '{"settings": {"gain": "much"}}'])
def test_a_spoilt_preference_is_as_none(tmp_path, text, caplog):
    settings = Settings(tmp_path / "settings.json")
    settings.set(KEY, text)
    assert CameraMemory(settings).last is None
    assert "microscope.camera is ignored" in caplog.text
