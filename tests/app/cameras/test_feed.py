"""The feed's thread, with cameras that wait for the test."""

import logging
import queue
import threading

import numpy as np
import pytest

from rotemina.app.cameras.feed import CameraFeed, FeedState
from rotemina.drivers.cameras.camera import Camera, CameraIdentity, Picture
from rotemina.drivers.cameras.errors import CameraLostError
from rotemina.drivers.cameras.settings import (
    CameraDescription,
    CameraSettings,
    PixelType,
    Trigger,
)
from rotemina.drivers.clock import VirtualClock
from rotemina.drivers.errors import StateError

PATIENCE_S = 5.0


class Puppet(Camera):
    """A camera that gives what the test has put into its queue: pixels, or an error."""

    def __init__(self, clock):
        super().__init__(CameraIdentity("puppet:0", "Puppet", "puppet"), clock=clock)
        self.wait = lambda _: None
        self.gives = queue.Queue()
        self.asked = threading.Semaphore(0)  # once for each grab that begins
        self.closed = threading.Event()
        self.refuses = None

    def _open(self):
        if self.refuses:
            raise self.refuses
        self.closed.clear()
        both = (Trigger.FREE, Trigger.SOFTWARE)
        return CameraDescription(40, 30, (PixelType.MONO8,), both, exposure_s=(1e-3, 10.0))

    def _close(self):
        self.closed.set()

    def _grab(self, timeout_s):
        self.asked.release()
        given = self.gives.get()
        if isinstance(given, Exception):
            raise given
        if given is None:
            return None
        return Picture(given, 8, self.clock(), exposure_s=self.settings.exposure_s)

    def next_asked(self):
        """Wait until the thread is in the next grab, and so is done with what came before."""
        assert self.asked.acquire(timeout=PATIENCE_S)


def picture(level=100, seed=0):
    return np.random.default_rng(seed).integers(level, level + 20, (30, 40)).astype(np.uint8)


@pytest.fixture
def clock():
    return VirtualClock(50.0)


@pytest.fixture
def camera(clock):
    return Puppet(clock)


@pytest.fixture
def feed(camera, clock):
    feed = CameraFeed(camera, clock=clock)
    yield feed
    for _ in range(3):
        camera.gives.put(None)
    assert feed.close(PATIENCE_S)


def shown(camera, pixels):
    """Let the camera give this, and wait until it is out."""
    camera.gives.put(pixels)
    camera.next_asked()


def test_the_newest_picture_and_its_age(feed, camera, clock):
    assert feed.view.state is FeedState.CLOSED
    feed.start()
    camera.next_asked()
    for seed in range(3):
        clock.advance(0.1)
        shown(camera, picture(seed=seed))
    clock.advance(0.25)
    view = feed.view
    assert (view.state, view.frame.number) == (FeedState.LIVE, 2)
    np.testing.assert_array_equal(feed.newest.pixels, picture(seed=2))
    assert view.age_s == pytest.approx(0.25)
    assert view.rate_hz == pytest.approx(10.0)
    assert view.description.width == 40


def test_a_camera_that_hangs_is_stalled_and_hinders_nobody(feed, camera, clock):
    feed.start()
    camera.next_asked()
    shown(camera, picture())
    clock.advance(1.5)  # its thread is waiting inside the camera
    view = feed.view
    assert view.state is FeedState.STALLED
    assert "1.5 s" in view.reason
    assert feed.close(timeout_s=0.0) is False
    with pytest.raises(StateError, match="still running"):
        feed.start()
    camera.gives.put(picture())
    assert feed.close(PATIENCE_S)


def test_a_long_exposure_is_no_stall(feed, camera, clock):
    feed.start(CameraSettings(exposure_s=2.0))
    camera.next_asked()
    shown(camera, picture())
    clock.advance(5.0)
    assert feed.view.state is FeedState.LIVE
    clock.advance(2.0)
    assert feed.view.state is FeedState.STALLED


def test_unplugged_while_live_and_started_again(feed, camera):
    feed.start()
    camera.next_asked()
    shown(camera, picture())
    camera.gives.put(CameraLostError("Puppet: gone; open it again"))
    assert camera.closed.wait(PATIENCE_S)
    feed.close(PATIENCE_S)
    view = feed.view
    assert (view.state, view.reason) == (FeedState.LOST, "Puppet: gone; open it again")
    assert view.frame is not None  # the last picture stays, with its age
    feed.start()
    camera.next_asked()
    assert feed.view.state is FeedState.LIVE


def test_a_camera_that_cannot_be_opened(feed, camera):
    camera.refuses = CameraLostError("Puppet: not connected; plug it in")
    feed.start()
    assert feed.close(PATIENCE_S)
    assert (feed.view.state, feed.view.frame) == (FeedState.LOST, None)
    assert "plug it in" in feed.view.reason


def test_a_failed_read_is_a_lost_picture_and_a_second_of_them_the_end(feed, camera, clock, caplog):
    feed.start()
    camera.next_asked()
    shown(camera, picture(seed=1))
    for number, bad in enumerate((ZeroDivisionError("oops"), picture()[:0], picture()[1:]), 1):
        shown(camera, bad)
        assert (feed.view.state, feed.newest.number) == (FeedState.LIVE, 2 * number - 2)
        shown(camera, picture(seed=1 + number))
        assert (feed.newest.lost, feed.newest.number) == (number, 2 * number)
    shown(camera, ZeroDivisionError("oops"))
    clock.advance(1.0)
    camera.gives.put(ZeroDivisionError("oops"))
    assert camera.closed.wait(PATIENCE_S)
    feed.close(PATIENCE_S)
    assert feed.view.state is FeedState.LOST
    assert feed.view.reason == (
        "Puppet: no picture could be read for 1.0 s; the log has the cause. Check the camera and "
        "its cable, and open it again"
    )
    assert "ZeroDivisionError: oops" in caplog.text


def test_what_a_plugin_raises_when_it_is_opened_is_in_the_log_alone(feed, camera, caplog):
    camera.refuses = ZeroDivisionError("oops")
    feed.start()
    assert feed.close(PATIENCE_S)
    assert feed.view.state is FeedState.LOST
    assert feed.view.reason.startswith("Puppet failed; the log has the cause. Check")
    assert "ZeroDivisionError: oops" in caplog.text


@pytest.mark.parametrize("buffers", [1, 2, 3, 4])
def test_a_frozen_camera_gives_no_new_pictures(feed, camera, clock, buffers):
    taken = []
    feed.listen(lambda frame: taken.append(frame.number))
    feed.start()
    camera.next_asked()
    for number in range(buffers + 12):
        clock.advance(0.1)
        shown(camera, picture(seed=number % buffers))
    view = feed.view
    assert view.state is FeedState.FROZEN
    assert "repeated earlier pictures" in view.reason
    assert view.age_s == pytest.approx(1.2)
    assert view.frame.number == buffers - 1
    assert taken == list(range(buffers))
    clock.advance(1.5)
    assert feed.view.state is FeedState.STALLED  # not even a repetition comes
    shown(camera, picture(seed=99))
    assert (feed.view.state, feed.view.age_s) == (FeedState.LIVE, 0.0)


def test_black_with_the_reason(feed, camera):
    feed.start()
    camera.next_asked()
    shown(camera, np.zeros((30, 40), np.uint8))
    assert feed.view.state is FeedState.BLACK
    assert "lamp" in feed.view.reason


def test_settings_that_are_refused_are_told(feed, camera):
    feed.start()
    camera.next_asked()
    feed.configure(CameraSettings(exposure_s=99.0))
    shown(camera, picture())
    assert "exposure_s = 99" in feed.view.problem
    feed.configure(CameraSettings(exposure_s=0.5))
    shown(camera, picture())
    assert (feed.view.problem, feed.view.settings.exposure_s) == ("", 0.5)


def test_triggers_take_one_picture_each(feed, camera, clock):
    taken = []
    told = threading.Semaphore(0)

    def tell(frame):
        taken.append(frame.number)
        told.release()

    feed.listen(tell)
    feed.start(CameraSettings(trigger=Trigger.SOFTWARE))
    for number in range(2):
        feed.trigger()
        camera.next_asked()
        camera.gives.put(picture(seed=number))
        assert told.acquire(timeout=PATIENCE_S)
    assert taken == [0, 1]
    clock.advance(60.0)
    assert feed.view.state is FeedState.WAITING
    feed.trigger()
    camera.next_asked()
    camera.gives.put(picture() * np.uint8(0))
    assert told.acquire(timeout=PATIENCE_S)
    clock.advance(60.0)
    assert feed.view.state is FeedState.BLACK
    assert not camera.asked.acquire(blocking=False)


def test_listeners_are_told_every_picture_and_a_bad_one_hinders_nobody(feed, camera, caplog):
    taken = []
    feed.listen(lambda frame: 1 / 0)
    leave = feed.listen(lambda frame: taken.append(frame.number))
    with caplog.at_level(logging.CRITICAL):
        feed.start()
        camera.next_asked()
        shown(camera, picture(seed=1))
        shown(camera, picture(seed=2))
        leave()
        shown(camera, picture(seed=3))
    assert taken == [0, 1]
    assert feed.newest.number == 2


def test_it_closes_the_camera_and_says_so(feed, camera):
    feed.start()
    camera.next_asked()
    shown(camera, picture())
    camera.gives.put(None)
    feed.close(PATIENCE_S)
    assert camera.closed.is_set()
    assert feed.view.state is FeedState.CLOSED
