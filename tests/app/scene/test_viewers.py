"""How fast viewers are told: never faster than they draw, and no backlog."""

import pytest

from rotemina.app.scene.scene import Scene
from rotemina.app.scene.viewers import FRAME_S, Viewer


class Line:
    """Keeps what was sent."""

    def __init__(self):
        self.sent = []

    def send(self, commands):
        self.sent.append([command["value"] for command in commands])

    def end(self):
        pass


class Timing:
    """A loop whose time is set by hand."""

    def __init__(self):
        self.now_s = 100.0
        self.due = []

    def time(self):
        return self.now_s

    def call_later(self, delay, callback):
        self.due.append((self.now_s + delay, callback))
        return self

    def cancel(self):
        self.due.clear()

    def advance(self, seconds):
        self.now_s += seconds
        ready = [callback for at, callback in self.due if at <= self.now_s]
        self.due = [each for each in self.due if each[0] > self.now_s]
        for callback in ready:
            callback()


@pytest.fixture
def place():
    scene, line, timing = Scene(), Line(), Timing()
    return scene, line, timing, Viewer(scene, line, timing)


def put(scene, value):
    scene.put({"type": "set_transform", "path": "/a", "value": value})


def test_a_slow_viewer_gets_the_newest_and_no_backlog(place):
    scene, line, timing, viewer = place
    for value in range(1000):
        put(scene, value)
        timing.advance(FRAME_S)
        viewer.tell()
    assert line.sent == [[0]]
    viewer.drawn()
    assert line.sent == [[0], [999]]


def test_a_fast_viewer_is_told_thirty_times_a_second_at_most(place):
    scene, line, timing, viewer = place
    for value in range(1000):
        put(scene, value)
        viewer.tell()
        viewer.drawn()
        timing.advance(0.001)
    assert 29 <= len(line.sent) <= 31
    timing.advance(FRAME_S)
    assert line.sent[-1] == [999]


def test_nothing_is_sent_where_nothing_is_new(place):
    scene, line, timing, viewer = place
    put(scene, 1)
    viewer.tell()
    for _ in range(5):
        timing.advance(1.0)
        viewer.drawn()
    assert line.sent == [[1]]


def test_who_has_left_is_told_nothing(place):
    scene, line, timing, viewer = place
    put(scene, 1)
    viewer.tell()
    viewer.drawn()
    put(scene, 2)
    viewer.tell()  # has to wait for its time
    viewer.end()
    timing.advance(1.0)
    viewer.tell()
    assert line.sent == [[1]]
