"""Viewers get updates no faster than they draw, and no backlog."""

import pytest

from rotemina.app.scene import SceneCommandStore
from rotemina.app.scene.viewers import MIN_MESSAGE_INTERVAL_S, SceneViewer


class FakeConnection:
    """A connection that records the commands sent."""

    def __init__(self):
        self.sent = []

    def send(self, commands):
        self.sent.append([command["value"] for command in commands])

    def end(self):
        pass


class FakeEventLoop:
    """An event loop whose time the test advances."""

    def __init__(self):
        self.now_s = 100.0
        self.timers = []

    def time(self):
        return self.now_s

    def call_later(self, delay, callback):
        self.timers.append((self.now_s + delay, callback))
        return self

    def cancel(self):
        self.timers.clear()

    def advance(self, seconds):
        self.now_s += seconds
        ready = [callback for due_s, callback in self.timers if due_s <= self.now_s]
        self.timers = [timer for timer in self.timers if timer[0] > self.now_s]
        for callback in ready:
            callback()


@pytest.fixture
def connected_viewer():
    scene, connection, loop = SceneCommandStore(), FakeConnection(), FakeEventLoop()
    return scene, connection, loop, SceneViewer(scene, connection, loop)


def put(scene, value):
    scene.put({"type": "set_transform", "path": "/a", "value": value})


def test_slow_viewer_gets_the_newest_command_and_no_backlog(connected_viewer):
    scene, connection, loop, viewer = connected_viewer
    for value in range(1000):
        put(scene, value)
        loop.advance(MIN_MESSAGE_INTERVAL_S)
        viewer.send_changes()
    assert connection.sent == [[0]]
    viewer.on_drawn()
    assert connection.sent == [[0], [999]]


def test_fast_viewer_gets_at_most_thirty_updates_per_second(connected_viewer):
    scene, connection, loop, viewer = connected_viewer
    for value in range(1000):
        put(scene, value)
        viewer.send_changes()
        viewer.on_drawn()
        loop.advance(0.001)
    assert 29 <= len(connection.sent) <= 31
    loop.advance(MIN_MESSAGE_INTERVAL_S)
    assert connection.sent[-1] == [999]


def test_nothing_is_sent_without_changes(connected_viewer):
    scene, connection, loop, viewer = connected_viewer
    put(scene, 1)
    viewer.send_changes()
    for _ in range(5):
        loop.advance(1.0)
        viewer.on_drawn()
    assert connection.sent == [[1]]


def test_disconnected_viewer_gets_nothing(connected_viewer):
    scene, connection, loop, viewer = connected_viewer
    put(scene, 1)
    viewer.send_changes()
    viewer.on_drawn()
    put(scene, 2)
    viewer.send_changes()  # waits for the minimum interval
    viewer.end()
    loop.advance(1.0)
    viewer.send_changes()
    assert connection.sent == [[1]]
