"""Saved positions: a file is read completely or not at all, and the path to them is safe."""

import numpy as np
import pytest

from rotemina.app.errors import RequestRefusedError, SavedPositionError
from rotemina.app.motion.session import SavedPositions
from rotemina.app.motion.session.undo import plan_safe_path
from rotemina.drivers.simulator import Simulator
from rotemina.sim.errors import OutOfLimitsError
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
MIDDLE = {name: sum(axis.range) / 2 for name, axis in ROBOT.axes.items()}
ABOVE = {**MIDDLE, "x": 0.01, "z": 0.041234567890123}


@pytest.fixture
def positions(tmp_path):
    return SavedPositions(tmp_path, ROBOT)


@pytest.fixture
def machine(make_harness):
    harness = make_harness(driver=Simulator)
    harness.step()
    return harness


def test_saved_positions_are_read_at_the_next_start(tmp_path, positions):
    positions.save("above the dish", ABOVE)
    positions.save("µ-Küvette „A“", MIDDLE)
    reloaded = SavedPositions(tmp_path, ROBOT)
    reloaded.read()
    assert reloaded.positions == {"above the dish": ABOVE, "µ-Küvette „A“": MIDDLE}
    reloaded.delete("above the dish")
    positions.read()
    assert list(positions.positions) == ["µ-Küvette „A“"]
    with pytest.raises(SavedPositionError, match="no position 'above the dish'"):
        positions.delete("above the dish")


@pytest.mark.parametrize(
    ("name", "position", "message"),
    [
        ("", MIDDLE, "is not a valid name"),
        ("a\nb", MIDDLE, "is not a valid name"),
        ("a" * 41, MIDDLE, "is not a valid name"),
        ("a", {"x": 0.0}, "axis thx is missing"),
        ("a", {**MIDDLE, "w": 0.0}, "no axis 'w'"),
        ("a", {**MIDDLE, "x": 0.06}, "x.*55"),
        ("a", {**MIDDLE, "zn": float("nan")}, "zn"),
    ],
)
def test_an_invalid_position_is_not_saved(positions, name, position, message):
    with pytest.raises(SavedPositionError, match=message):
        positions.save(name, position)
    assert not positions.path.exists()


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda text: text.replace("0.01\n", "0.06\n"), "position 'b': .*x"),
        (lambda text: text.replace("0.01\n", '"0.01"\n'), r"positions\.b\.x.*number"),
        (lambda text: text.replace("zn =", "zm ="), "axis zn is missing"),
        (lambda text: text.replace(f'"{ROBOT.name}"', '"other"'), "to robot 'other'"),
        (lambda text: text.replace("robot =", "robots ="), "did you mean 'robot'"),
        (lambda text: text[:-5] + "[", "not valid TOML"),
    ],
)
def test_a_bad_file_is_neither_used_nor_overwritten(positions, change, message):
    positions.save("a", MIDDLE)
    positions.save("b", ABOVE)
    bad_text = change(positions.path.read_text("utf-8"))
    positions.path.write_text(bad_text, "utf-8")
    for request in (positions.read, lambda: positions.save("c", MIDDLE)):
        with pytest.raises(SavedPositionError, match=message) as error:
            request()
        assert str(positions.path) in str(error.value)
    assert not positions.positions
    assert positions.path.read_text("utf-8") == bad_text


def test_the_safe_path_lifts_crosses_and_lowers():
    lift, across, down = plan_safe_path(ROBOT, MIDDLE, ABOVE)
    assert lift == {"z": pytest.approx(max(MIDDLE["z"], ABOVE["z"]) + 1e-3)}
    assert across == {axis: position for axis, position in ABOVE.items() if axis != "z"}
    assert down == {"z": ABOVE["z"]}
    assert plan_safe_path(ROBOT, MIDDLE, {**MIDDLE, "z": 0.05}) == ({"z": 0.05},)
    highest = ROBOT.axes["z"].range[1]
    assert plan_safe_path(ROBOT, MIDDLE, {**ABOVE, "z": highest})[0] == {"z": highest}


def test_a_session_moves_on_the_safe_path_and_can_undo(machine):
    session = machine.session
    begin = session.snapshot().command
    with pytest.raises(OutOfLimitsError, match="y"):
        session.go_safely({**begin, "x": 0.03, "y": 0.9})
    assert machine.step(0.1, 5).command == begin
    target = {**begin, "x": begin["x"] + 1e-3, "z": begin["z"] - 2e-4}
    session.go_safely(target)
    machine.step()
    with pytest.raises(RequestRefusedError, match="before going there"):
        session.go_safely(target)
    assert machine.step_until_idle().command == pytest.approx(target, abs=1e-12)
    window = session.history.tail()
    x, z = window.command[:, 0], window.command[:, 2]
    is_crossing = (x > begin["x"] + 1e-6) & (x < target["x"] - 1e-6)
    assert is_crossing.any()
    assert z[is_crossing].min() >= begin["z"] + 0.99e-3
    session.undo()
    assert machine.step_until_idle().command == pytest.approx(begin, abs=1e-12)


def test_the_last_leg_down_is_slow_near_the_floor(machine):
    """This also holds if the end is higher than the start, because the tip is lifted between."""
    machine.session.bounds.teach_floor(clearance=1e-4)
    begin = machine.session.snapshot().command
    machine.session.go_safely({**begin, "x": begin["x"] + 1e-3, "z": begin["z"] + 1e-4})
    machine.step_until_idle()
    window = machine.session.history.tail()
    speed = np.diff(window.command[:, 2]) / np.diff(window.device_time_s)
    is_near_floor = window.command[1:, 2] < begin["z"] + 3.5e-4
    assert speed[is_near_floor].min() < -1e-4  # it came down
    assert speed[is_near_floor].min() > -0.55e-3
