"""The thread of the camera feed, with cameras that wait for the test."""

import logging
import queue
import threading

import numpy as np
import pytest

from rotemina.app.cameras import CameraFeed, FeedState
from rotemina.drivers.cameras import (
    Camera,
    CameraDescription,
    CameraIdentity,
    CameraSettings,
    CameraTrigger,
    PixelType,
    RawFrame,
)
from rotemina.drivers.contract import CameraLostError, StateError, VirtualClock

PATIENCE_S = 5.0


class ScriptedCamera(Camera):
    """A camera that returns the pixels, or raises the errors, that the test puts in its queue."""

    def __init__(self, clock):
        super().__init__(CameraIdentity("puppet:0", "Puppet", "puppet"), clock=clock)
        self.wait = lambda _: None
        self.items = queue.Queue()
        self.grab_started = threading.Semaphore(0)  # released at the start of each grab
        self.closed = threading.Event()
        self.open_error = None

    def _open(self):
        if self.open_error:
            raise self.open_error
        self.closed.clear()
        triggers = (CameraTrigger.FREE, CameraTrigger.SOFTWARE)
        return CameraDescription(40, 30, (PixelType.MONO8,), triggers, exposure_s=(1e-3, 10.0))

    def _close(self):
        self.closed.set()

    def _grab(self, timeout_s):
        self.grab_started.release()
        item = self.items.get()
        if isinstance(item, Exception):
            raise item
        if item is None:
            return None
        return RawFrame(item, 8, self.clock(), exposure_s=self.settings.exposure_s)

    def wait_for_grab(self):
        """Wait until the thread starts the next grab, which means the last one is processed."""
        assert self.grab_started.acquire(timeout=PATIENCE_S)


def make_pixels(level=100, seed=0):
    return np.random.default_rng(seed).integers(level, level + 20, (30, 40)).astype(np.uint8)


@pytest.fixture
def clock():
    return VirtualClock(50.0)


@pytest.fixture
def camera(clock):
    return ScriptedCamera(clock)


@pytest.fixture
def feed(camera, clock):
    feed = CameraFeed(camera, clock=clock)
    yield feed
    for _ in range(3):
        camera.items.put(None)
    assert feed.close(PATIENCE_S)


def deliver(camera, pixels):
    """Let the camera return these pixels and wait until the feed has them."""
    camera.items.put(pixels)
    camera.wait_for_grab()


def test_view_has_the_newest_picture_and_its_age(feed, camera, clock):
    assert feed.view.state is FeedState.CLOSED
    feed.start()
    camera.wait_for_grab()
    for seed in range(3):
        clock.advance(0.1)
        deliver(camera, make_pixels(seed=seed))
    clock.advance(0.25)
    view = feed.view
    assert (view.state, view.frame.number) == (FeedState.LIVE, 2)
    np.testing.assert_array_equal(feed.newest.pixels, make_pixels(seed=2))
    assert view.age_s == pytest.approx(0.25)
    assert view.rate_hz == pytest.approx(10.0)
    assert view.description.width == 40


def test_hanging_camera_is_stalled_and_blocks_nothing(feed, camera, clock):
    feed.start()
    camera.wait_for_grab()
    deliver(camera, make_pixels())
    clock.advance(1.5)  # its thread is waiting inside the camera
    view = feed.view
    assert view.state is FeedState.STALLED
    assert "1.5 s" in view.reason
    assert feed.close(timeout_s=0.0) is False
    with pytest.raises(StateError, match="still running"):
        feed.start()
    camera.items.put(make_pixels())
    assert feed.close(PATIENCE_S)


def test_long_exposure_is_not_a_stall(feed, camera, clock):
    feed.start(CameraSettings(exposure_s=2.0))
    camera.wait_for_grab()
    deliver(camera, make_pixels())
    clock.advance(5.0)
    assert feed.view.state is FeedState.LIVE
    clock.advance(2.0)
    assert feed.view.state is FeedState.STALLED


def test_camera_unplugged_while_live_can_be_started_again(feed, camera):
    feed.start()
    camera.wait_for_grab()
    deliver(camera, make_pixels())
    camera.items.put(CameraLostError("Puppet: gone; open it again"))
    assert camera.closed.wait(PATIENCE_S)
    feed.close(PATIENCE_S)
    view = feed.view
    assert (view.state, view.reason) == (FeedState.LOST, "Puppet: gone; open it again")
    assert view.frame is not None  # the last picture stays, with its age
    feed.start()
    camera.wait_for_grab()
    assert feed.view.state is FeedState.LIVE


@pytest.mark.parametrize(
    ("error", "reason", "log_text"),
    [
        (CameraLostError("Puppet: not connected; plug it in"), "Puppet: not connected; plug", ""),
        (
            ZeroDivisionError("oops"),
            "Puppet failed; the log has the cause. Check",
            "ZeroDivisionError: oops",
        ),
    ],
)
def test_camera_that_cannot_be_opened_is_lost(feed, camera, caplog, error, reason, log_text):
    camera.open_error = error
    feed.start()
    assert feed.close(PATIENCE_S)
    assert (feed.view.state, feed.view.frame) == (FeedState.LOST, None)
    assert feed.view.reason.startswith(reason)
    assert log_text in caplog.text


def test_failed_reads_lose_pictures_and_end_the_feed_after_a_second(feed, camera, clock, caplog):
    feed.start()
    camera.wait_for_grab()
    deliver(camera, make_pixels(seed=1))
    for number, bad in enumerate(
        (ZeroDivisionError("oops"), make_pixels()[:0], make_pixels()[1:]), 1
    ):
        deliver(camera, bad)
        assert (feed.view.state, feed.newest.number) == (FeedState.LIVE, 2 * number - 2)
        deliver(camera, make_pixels(seed=1 + number))
        assert (feed.newest.lost, feed.newest.number) == (number, 2 * number)
    deliver(camera, ZeroDivisionError("oops"))
    clock.advance(1.0)
    camera.items.put(ZeroDivisionError("oops"))
    assert camera.closed.wait(PATIENCE_S)
    feed.close(PATIENCE_S)
    assert feed.view.state is FeedState.LOST
    assert feed.view.reason == (
        "Puppet: no picture could be read for 1.0 s; see the log for the cause. Check the camera "
        "and its cable, and open it again"
    )
    assert "ZeroDivisionError: oops" in caplog.text


@pytest.mark.parametrize("buffers", [1, 4])
def test_frozen_camera_gives_no_new_pictures(feed, camera, clock, buffers):
    numbers = []
    feed.listen(lambda frame: numbers.append(frame.number))
    feed.start()
    camera.wait_for_grab()
    for number in range(buffers + 12):
        clock.advance(0.1)
        deliver(camera, make_pixels(seed=number % buffers))
    view = feed.view
    assert view.state is FeedState.FROZEN
    assert "repeated earlier pictures" in view.reason
    assert view.age_s == pytest.approx(1.2)
    assert view.frame.number == buffers - 1
    assert numbers == list(range(buffers))
    clock.advance(1.5)
    assert feed.view.state is FeedState.STALLED  # no frames at all, not even repeated ones
    deliver(camera, make_pixels(seed=99))
    assert (feed.view.state, feed.view.age_s) == (FeedState.LIVE, 0.0)


def test_black_picture_is_reported_with_a_reason(feed, camera):
    feed.start()
    camera.wait_for_grab()
    deliver(camera, np.zeros((30, 40), np.uint8))
    assert feed.view.state is FeedState.BLACK
    assert "lamp" in feed.view.reason


def test_refused_settings_are_reported(feed, camera):
    feed.start()
    camera.wait_for_grab()
    feed.configure(CameraSettings(exposure_s=99.0))
    deliver(camera, make_pixels())
    assert "exposure_s = 99" in feed.view.problem
    feed.configure(CameraSettings(exposure_s=0.5))
    deliver(camera, make_pixels())
    assert (feed.view.problem, feed.view.settings.exposure_s) == ("", 0.5)


def test_each_trigger_takes_one_picture(feed, camera, clock):
    numbers = []
    received = threading.Semaphore(0)

    def receive(frame):
        numbers.append(frame.number)
        received.release()

    feed.listen(receive)
    feed.start(CameraSettings(trigger=CameraTrigger.SOFTWARE))
    for number in range(2):
        feed.trigger()
        camera.wait_for_grab()
        camera.items.put(make_pixels(seed=number))
        assert received.acquire(timeout=PATIENCE_S)
    assert numbers == [0, 1]
    clock.advance(60.0)
    assert feed.view.state is FeedState.WAITING
    feed.trigger()
    camera.wait_for_grab()
    camera.items.put(make_pixels() * np.uint8(0))
    assert received.acquire(timeout=PATIENCE_S)
    clock.advance(60.0)
    assert feed.view.state is FeedState.BLACK
    assert not camera.grab_started.acquire(blocking=False)


def test_listeners_get_every_picture_despite_a_failing_listener(feed, camera, caplog):
    numbers = []
    feed.listen(lambda frame: 1 / 0)
    unsubscribe = feed.listen(lambda frame: numbers.append(frame.number))
    with caplog.at_level(logging.CRITICAL):
        feed.start()
        camera.wait_for_grab()
        deliver(camera, make_pixels(seed=1))
        deliver(camera, make_pixels(seed=2))
        unsubscribe()
        deliver(camera, make_pixels(seed=3))
    assert numbers == [0, 1]
    assert feed.newest.number == 2


def test_close_closes_the_camera(feed, camera):
    feed.start()
    camera.wait_for_grab()
    deliver(camera, make_pixels())
    camera.items.put(None)
    feed.close(PATIENCE_S)
    assert camera.closed.is_set()
    assert feed.view.state is FeedState.CLOSED
