"""Viewers get the newest commands, and no command twice."""

import numpy as np

from rotemina.app.scene import SceneCommandStore
from rotemina.app.scene.scene import set_property, set_transform


def make_move(path, x):
    matrix = np.eye(4)
    matrix[0, 3] = x
    return set_transform(path, matrix)


def test_late_viewer_gets_the_newest_of_everything():
    scene = SceneCommandStore()
    for step in range(5):
        scene.put(make_move("/a", step), make_move("/b", -step))
    scene.put(set_property("/a", "visible", False))
    commands = scene.get_changes().commands
    assert [command["path"] for command in commands] == ["/a", "/b", "/a"]
    assert [command["matrix"][12] for command in commands[:2]] == [4.0, -4.0]


def test_only_changes_are_sent():
    scene = SceneCommandStore()
    scene.put(make_move("/a", 1.0), make_move("/b", 1.0))
    revision = scene.get_changes().revision
    scene.put(make_move("/a", 1.0), make_move("/b", 2.0))
    changes = scene.get_changes(revision)
    assert [command["path"] for command in changes.commands] == ["/b"]
    assert scene.get_changes(changes.revision).commands == ()


def test_unchanged_view_is_sent_again_on_request():
    scene = SceneCommandStore()
    view = {"type": "view", "eye": [1, 0, 0]}
    scene.put(view, again=True)
    revision = scene.get_changes().revision
    scene.put(view, again=True)
    assert scene.get_changes(revision).commands == (view,)
