"""A hidden machine moves by the generator's equations, tells nothing, and can be drawn anew."""

import numpy as np
import pytest

from rotemina.app.blind.hidden_machine import (
    HiddenMachine,
    HiddenMachineError,
    Secret,
    draw_secret,
    is_right,
)
from rotemina.app.blind.stepped_machine import STEPPED, SteppedPlant
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import CommandRefused, PlaybackFinished
from rotemina.drivers.clock import VirtualClock
from rotemina.drivers.samples import DeviceState
from rotemina.sim.blind.machine import Commands
from rotemina.sim.plant.random_draws import Chance
from rotemina.sim.records.record import Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.trajectory.worn_machine_demo import demonstration

ROBOT = load_robot("rotemina")


@pytest.fixture(scope="module")
def secret():
    return next(one for one in (draw_secret(ROBOT, seed) for seed in range(1, 9)) if one.causes)


def run_of(secret):
    clock = VirtualClock(3.0)
    session = MotionSession(HiddenMachine(ROBOT, secret, clock=clock))
    events = []
    session.subscribe(events.append)
    session.connect()

    def step(times=1):
        for _ in range(times):
            clock.advance(0.02)
            session.run_once()
        return session.snapshot()

    step(3)
    return session, events, step


def test_the_same_seed_is_the_same_machine_and_effects_are_of_the_catalogue(secret):
    assert draw_secret(ROBOT, secret.seed).causes == secret.causes
    assert {effect for _, effect in secret.causes} <= set(STEPPED)
    with pytest.raises(HiddenMachineError, match="no stages"):
        draw_secret(load_robot("fsm"), 1)


def test_some_machines_have_nothing():
    rng = [np.random.default_rng(seed).uniform() < 0.2 for seed in range(40)]
    healthy = rng.index(True)
    assert draw_secret(ROBOT, healthy).causes == frozenset()


@pytest.mark.parametrize("finer", [1, 2, 5])
def test_sample_by_sample_it_does_what_the_generator_does_over_the_whole_motion(secret, finer):
    case, tick_s = secret.case, 5e-4
    columns = [list(ROBOT.axes).index(name) for name in case.names]
    time_s = np.arange(2400) * tick_s
    low, high = np.array([ROBOT.axes[name].range for name in case.names]).T
    swing = np.sin(2 * np.pi * np.outer(time_s, [1.1, 2.3, 3.7]))
    commands = low + (high - low) * (0.5 + 0.42 * swing * np.linspace(1.0, 0.3, 2400)[:, None])
    middle = [sum(axis.range) / 2.0 for axis in ROBOT.axes.values()]
    whole = np.tile(middle, (len(time_s), 1))
    whole[:, columns] = commands
    plant = SteppedPlant(ROBOT, case)
    state = plant.at_rest(0.0, whole[0])
    told = []
    asked = np.repeat(whole, finer, axis=0)
    sampled_s = tick_s + np.arange(len(asked)) * tick_s / finer
    for first in range(0, len(asked), 37 * finer):
        part = slice(first, first + 37 * finer)
        chance = Chance(np.random.default_rng(0))
        motion, state = plant.advance(state, sampled_s[part], asked[part], chance=chance)
        told.append(motion.position[::finer, columns])
    run = case.machine.respond(Commands(tick_s, commands), 0)
    off = np.abs(np.concatenate(told) - run.motion)[800:].max(axis=0)  # once it has settled
    assert (off < 1e-3 * np.array([axis.floor for axis in case.machine.axes])).all()


def test_it_can_be_played_and_tells_nothing_of_what_it_has(secret):
    session, events, step = run_of(secret)
    session.play(demonstration(ROBOT))
    step()
    while step().activity is not DeviceState.IDLE:
        pass
    (finished,) = [event for event in events if isinstance(event, PlaybackFinished)]
    record = finished.record
    assert record.metadata["driver"] == "hidden machine"
    assert session.service.effects == ()
    said = " ".join([*record.metadata, *record.metadata.values()])
    assert not any(effect in said for _, effect in secret.causes)
    gap = record.signal("zn", Tap.MEAS) - record.signal("zn", Tap.CMD)
    assert np.abs(gap).max() < 1e-5  # it follows
    session.service.set_effects([AxisEffect(axis="zn", id="creep")])
    step()
    assert any(isinstance(e, CommandRefused) and "reveal it first" in e.message for e in events)


def test_right_is_all_that_is_there_and_nothing_else(secret):
    causes = secret.causes
    assert is_right(secret, causes)
    assert not is_right(secret, [*causes, ("x", "friction")])
    assert not is_right(secret, [])
    assert is_right(Secret(1, None), [])
