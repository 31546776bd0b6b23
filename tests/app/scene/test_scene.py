"""What a viewer is told: the newest of everything, and nothing twice."""

import numpy as np

from rotemina.app.scene.scene import Scene, set_property, set_transform


def moved(path, x):
    matrix = np.eye(4)
    matrix[0, 3] = x
    return set_transform(path, matrix)


def test_who_comes_late_gets_the_newest_of_everything():
    scene = Scene()
    for step in range(5):
        scene.put(moved("/a", step), moved("/b", -step))
    scene.put(set_property("/a", "visible", False))
    commands = scene.changes().commands
    assert [command["path"] for command in commands] == ["/a", "/b", "/a"]
    assert [command["matrix"][12] for command in commands[:2]] == [4.0, -4.0]


def test_only_what_is_new_is_told():
    scene = Scene()
    scene.put(moved("/a", 1.0), moved("/b", 1.0))
    seen = scene.changes().revision
    scene.put(moved("/a", 1.0), moved("/b", 2.0))
    changes = scene.changes(seen)
    assert [command["path"] for command in changes.commands] == ["/b"]
    assert scene.changes(changes.revision).commands == ()


def test_a_view_is_told_again_though_it_is_the_same():
    scene = Scene()
    view = {"type": "view", "eye": [1, 0, 0]}
    scene.put(view, again=True)
    seen = scene.changes().revision
    scene.put(view, again=True)
    assert scene.changes(seen).commands == (view,)


def test_matrices_are_told_column_by_column():
    assert moved("/a", 7.0)["matrix"] == [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 7, 0, 0, 1]
