"""Saved positions: the file comes back as it was written, or not at all; the way there is safe."""

import numpy as np
import pytest

from rotemina.app.motion.mailbox import RefusedError
from rotemina.app.motion.saved_positions import SavedPositionError, SavedPositions
from rotemina.app.motion.undo import safe_path
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.robot.file import load_robot
from rotemina.sim.trajectory.axis_limits import OutOfLimitsError

ROBOT = load_robot("rotemina")
MIDDLE = {name: sum(axis.range) / 2 for name, axis in ROBOT.axes.items()}
ABOVE = {**MIDDLE, "x": 0.01, "z": 0.041234567890123}


@pytest.fixture
def positions(tmp_path):
    return SavedPositions(tmp_path, ROBOT)


def test_what_was_kept_is_read_by_the_next_start(tmp_path, positions):
    positions.keep("above the dish", ABOVE)
    positions.keep("µ-Küvette „A“", MIDDLE)
    again = SavedPositions(tmp_path, ROBOT)
    again.read()
    assert again.kept == {"above the dish": ABOVE, "µ-Küvette „A“": MIDDLE}
    again.delete("above the dish")
    positions.read()
    assert list(positions.kept) == ["µ-Küvette „A“"]
    with pytest.raises(SavedPositionError, match="no position 'above the dish'"):
        positions.delete("above the dish")


@pytest.mark.parametrize(
    ("name", "place", "wrong"),
    [
        ("", MIDDLE, "is not a valid name"),
        (" a", MIDDLE, "is not a valid name"),
        ("a\nb", MIDDLE, "is not a valid name"),
        ("a" * 41, MIDDLE, "is not a valid name"),
        ("a", {"x": 0.0}, "axis thx is missing"),
        ("a", {**MIDDLE, "w": 0.0}, "no axis 'w'"),
        ("a", {**MIDDLE, "x": 0.06}, "x.*55"),
        ("a", {**MIDDLE, "zn": float("nan")}, "zn"),
    ],
)
def test_what_is_no_position_of_the_robot_is_not_kept(positions, name, place, wrong):
    with pytest.raises(SavedPositionError, match=wrong):
        positions.keep(name, place)
    assert not positions.path.exists()


@pytest.mark.parametrize(
    ("change", "wrong"),
    [
        (lambda text: text.replace("0.01\n", "0.06\n"), "position 'b': .*x"),
        (lambda text: text.replace("0.01\n", '"0.01"\n'), r"positions\.b\.x.*number"),
        (lambda text: text.replace("zn =", "zm ="), "axis zn is missing"),
        (lambda text: text.replace('"rotemina"', '"other"'), "to robot 'other'"),
        (lambda text: text.replace("robot =", "robots ="), "did you mean 'robot'"),
        (lambda text: text[:-5] + "[", "not valid TOML"),
    ],
)
def test_a_bad_file_is_used_in_no_part_and_never_written_over(positions, change, wrong):
    positions.keep("a", MIDDLE)
    positions.keep("b", ABOVE)
    spoilt = change(positions.path.read_text("utf-8").replace(f'"{ROBOT.name}"', '"rotemina"'))
    spoilt = spoilt if '"other"' in spoilt else spoilt.replace('"rotemina"', f'"{ROBOT.name}"')
    positions.path.write_text(spoilt, "utf-8")
    for request in (positions.read, lambda: positions.keep("c", MIDDLE)):
        with pytest.raises(SavedPositionError, match=wrong) as told:
            request()
        assert str(positions.path) in str(told.value)
    assert not positions.kept
    assert positions.path.read_text("utf-8") == spoilt


def test_the_way_lifts_crosses_and_comes_down():
    lift, across, down = safe_path(ROBOT, MIDDLE, ABOVE)
    assert lift == {"z": pytest.approx(max(MIDDLE["z"], ABOVE["z"]) + 1e-3)}
    assert across == {axis: at for axis, at in ABOVE.items() if axis != "z"}
    assert down == {"z": ABOVE["z"]}
    assert safe_path(ROBOT, MIDDLE, {**MIDDLE, "z": 0.05}) == ({"z": 0.05},)
    highest = ROBOT.axes["z"].range[1]
    assert safe_path(ROBOT, MIDDLE, {**ABOVE, "z": highest})[0] == {"z": highest}


def test_a_session_goes_there_safely_and_can_come_back(make_stepped):
    stepped = make_stepped(driver=Simulator)
    stepped.step()
    begin = stepped.session.snapshot().command
    goal = {**begin, "x": begin["x"] + 1e-3, "z": begin["z"] - 2e-4}
    stepped.session.go_safely(goal)
    stepped.step()
    with pytest.raises(RefusedError, match="before going there"):
        stepped.session.go_safely(goal)
    assert stepped.until_idle().command == pytest.approx(goal, abs=1e-12)
    window = stepped.session.history.tail()
    x, z = window.command[:, 0], window.command[:, 2]
    across = (x > begin["x"] + 1e-6) & (x < goal["x"] - 1e-6)
    assert across.any()
    assert z[across].min() >= begin["z"] + 0.99e-3
    stepped.session.undo()
    assert stepped.until_idle().command == pytest.approx(begin, abs=1e-12)


def test_a_place_out_of_range_moves_nothing(make_stepped):
    stepped = make_stepped(driver=Simulator)
    stepped.step()
    begin = stepped.session.snapshot().command
    with pytest.raises(OutOfLimitsError, match="y"):
        stepped.session.go_safely({**begin, "x": 0.03, "y": 0.9})
    assert stepped.step(0.1, 5).command == begin


def test_the_last_leg_down_is_slow_close_above_the_floor(make_stepped):
    """Also where it ends higher than it began: the tip was lifted between the two."""
    stepped = make_stepped(driver=Simulator)
    stepped.step()
    stepped.session.bounds.teach_floor(clearance=1e-4)
    begin = stepped.session.snapshot().command
    stepped.session.go_safely({**begin, "x": begin["x"] + 1e-3, "z": begin["z"] + 1e-4})
    stepped.until_idle()
    window = stepped.session.history.tail()
    speed = np.diff(window.command[:, 2]) / np.diff(window.device_time_s)
    close = window.command[1:, 2] < begin["z"] + 3.5e-4
    assert speed[close].min() < -1e-4  # it came down
    assert speed[close].min() > -0.55e-3
