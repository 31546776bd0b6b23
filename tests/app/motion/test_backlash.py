"""One-sided approaches: from which side axes come, what bounds them, and when they are not made."""

import numpy as np
import pytest

from rotemina.app.motion.backlash import Approach, play_of
from rotemina.app.motion.mailbox import RefusedError
from rotemina.drivers.samples import DeviceState
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.trajectory.axis_limits import OutOfLimitsError

ROBOT = load_robot("rotemina")
X = tuple(ROBOT.axes).index("x")
W = 20e-6
RISING = Approach(W, rising=True)
AT = ROBOT.axes["x"].range[1] / 2


@pytest.fixture
def machine(make_stepped):
    stepped = make_stepped()
    stepped.seen = []
    stepped.session.tap(lambda samples, _: stepped.seen.append(samples))
    stepped.step(0.05, 3)
    stepped.session.go_to({"x": AT})
    settle(stepped)
    stepped.session.backlash.use("x", RISING)
    return stepped


def settle(stepped):
    stepped.step(0.02, 2)
    while not stepped.session.at_rest:
        stepped.step(0.02)


def way(stepped, act):
    """Do something and return x's commands (n,) until the machine rests."""
    stepped.seen.clear()
    act()
    settle(stepped)
    return np.concatenate([one.command[:, X] for one in stepped.seen])


def test_every_target_is_come_to_from_below(machine):
    session = machine.session
    assert not session.backlash.taken_up("x")  # nobody knows how it came there
    for act, lowest in (
        (lambda: session.jog("x", 5e-6), AT + 5e-6 - W),  # too short to take up the play
        (lambda: session.jog("x", 1e-6), AT + 5e-6),  # taken up: straight
        (lambda: session.jog("x", -1e-6), AT + 5e-6 - W),
        (lambda: session.go_to({"x": AT + 1e-3}), AT + 5e-6),
        (lambda: session.go_to({"x": AT - 1e-3}), AT - 1e-3 - W),
        (session.undo, AT - 1e-3),
        (lambda: session.go_safely({"x": AT - 2e-3}), AT - 2e-3 - W),
    ):
        command = way(machine, act)
        assert command.min() == pytest.approx(lowest, abs=1e-9)
        turns = np.flatnonzero(np.diff(command))
        assert command[turns[-1] + 1] > command[turns[-1]]
        assert session.backlash.taken_up("x")
    assert command[-1] == pytest.approx(AT - 2e-3, abs=1e-9)


def test_with_backlash_targets_from_both_sides_read_alike(machine):
    session = machine.session
    play = AxisEffect(axis="x", id="backlash", parameters={"width": 0.5 * W})
    session.service.set_effects([play])
    settle(machine)
    apart = []
    for approach in (None, RISING):
        session.backlash.use("x", approach)
        read = []
        for other in (AT + 1e-3, AT - 1e-3):
            session.go_to({"x": other})
            settle(machine)
            session.go_to({"x": AT})
            settle(machine)
            machine.step(0.02, 25)
            read.append(session.snapshot().measured["x"])
        apart.append(abs(read[0] - read[1]))
    assert apart[0] > 0.4 * W
    assert apart[1] < 0.05 * W


def test_a_falling_approach_comes_from_above(machine):
    machine.session.backlash.use("x", Approach(W, rising=False))
    command = way(machine, lambda: machine.session.jog("x", 1e-4))
    assert command.max() == pytest.approx(AT + 1e-4 + W, abs=1e-9)
    assert command[-1] == pytest.approx(AT + 1e-4, abs=1e-9)


def test_an_approach_passes_range_narrowed_range_and_floor(machine):
    session = machine.session
    with pytest.raises(OutOfLimitsError, match=r"to 10 µm begins at -10 µm, outside 0 .* 20 µm"):
        session.go_to({"x": 1e-5})
    session.ranges.narrow("x", AT - 1e-3, AT + 1e-3)
    with pytest.raises(OutOfLimitsError, match="one-sided approach to"):
        session.go_to({"x": AT - 1e-3 + 0.5 * W})
    session.go_to({"x": AT - 1e-3 + W})
    settle(machine)
    session.bounds.teach_floor(5e-6)
    session.backlash.use("z", Approach(W, rising=True))
    with pytest.raises(OutOfLimitsError, match=r"floor.*the one-sided approach begins there"):
        session.jog("z", -1e-6)
    session.backlash.use("z", Approach(W, rising=False))
    session.jog("z", -1e-6)
    settle(machine)


def test_who_moves_another_axis_meanwhile_does_not_leave_it_beyond_its_target(machine):
    session = machine.session
    session.go_to({"x": AT - 1e-3})
    machine.step(0.02, 3)
    session.jog("y", 1e-4)
    settle(machine)
    assert session.snapshot().command["x"] == pytest.approx(AT - 1e-3, abs=1e-9)
    session.jog("x", -1e-4)
    session.jog("y", 1e-4)  # before the first of them was begun
    settle(machine)
    assert session.snapshot().command["x"] == pytest.approx(AT - 1.1e-3, abs=1e-9)


def test_a_jog_on_the_way_counts_from_the_target_not_from_beyond_it(machine):
    session = machine.session
    session.jog("x", -1e-3)
    machine.step(0.02, 3)
    session.jog("x", -1e-3)
    settle(machine)
    assert session.snapshot().command["x"] == pytest.approx(AT - 2e-3, abs=1e-9)
    assert not session.backlash.taken_up("x")


def test_a_stop_on_the_way_beyond_ends_it_there(machine):
    session = machine.session
    session.go_to({"x": AT - 1e-3})
    machine.step(0.02, 3)
    session.stop()
    settle(machine)
    machine.step(0.05, 10)
    halted = session.snapshot().command["x"]
    assert halted > AT - 1e-3
    assert not session.backlash.taken_up("x")


def test_speeds_do_not_go_beyond_and_the_play_counts_as_not_taken_up(machine):
    session = machine.session
    way(machine, lambda: session.jog("x", 1e-6))
    assert session.backlash.taken_up("x")
    command = way(machine, lambda: session.move_velocity({"x": -1e-4}, 0.1))
    assert (np.diff(command) <= 0.0).all()
    assert not session.backlash.taken_up("x")


def test_what_is_no_approach_is_refused_with_the_bound(machine):
    session = machine.session
    with pytest.raises(OutOfLimitsError, match="zn is not a stepper axis"):
        session.backlash.use("zn", RISING)
    for width in (0.0, 1e-3, float("nan")):
        with pytest.raises(OutOfLimitsError, match="above 0 and at most 550 µm"):
            session.backlash.use("x", Approach(width, rising=True))
    session.jog("x", 1e-3)
    machine.step(0.02)
    with pytest.raises(RefusedError, match="still moving"):
        session.backlash.use("x", None)
    settle(machine)
    assert machine.session.snapshot().activity is DeviceState.IDLE
    session.use(type(machine.driver)(ROBOT, clock=machine.clock))
    assert session.backlash.applied == {}


def test_the_play_is_that_of_enabled_backlash_on_the_axis():
    def effect(axis="x", name="backlash", *, enabled=True, **parameters):
        return AxisEffect(axis=axis, id=name, parameters=parameters, enabled=enabled)

    effects = (
        effect(width=1e-6),
        effect(width=5e-6, enabled=False),
        effect("y", width=3e-6),
        effect(name="periodic_error"),
    )
    assert play_of(ROBOT, effects, "x") == pytest.approx(1e-6)
    assert play_of(ROBOT, effects, "z") is None
