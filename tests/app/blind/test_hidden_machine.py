"""A hidden machine follows the generator's equations, reveals nothing and is reproducible."""

import numpy as np
import pytest

from rotemina.app.blind import (
    HiddenEffects,
    HiddenMachineSimulator,
    draw_hidden_effects,
    is_diagnosis_right,
)
from rotemina.app.blind.stepped_machine import STEPPED_EFFECTS, SteppedPlant
from rotemina.app.errors import HiddenMachineError
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import CommandRefused, PlaybackFinished
from rotemina.drivers.contract import DeviceState, VirtualClock
from rotemina.sim.blind.machine import SampledCommands
from rotemina.sim.plant import RandomStreams
from rotemina.sim.records import Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.trajectory import make_demonstration

ROBOT = load_robot("rotemina")


@pytest.fixture(scope="module")
def hidden_effects():
    drawn = draw_hidden_effects(ROBOT, 1)
    assert drawn.causes
    return drawn


def start_hidden_session(hidden_effects):
    clock = VirtualClock(3.0)
    session = MotionSession(HiddenMachineSimulator(ROBOT, hidden_effects, clock=clock))
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


def test_same_seed_draws_same_machine_with_known_effects(hidden_effects):
    assert draw_hidden_effects(ROBOT, hidden_effects.seed).causes == hidden_effects.causes
    assert {effect for _, effect in hidden_effects.causes} <= set(STEPPED_EFFECTS)
    with pytest.raises(HiddenMachineError, match="no stages"):
        draw_hidden_effects(load_robot("fsm"), 1)


def test_some_machines_are_healthy():
    assert draw_hidden_effects(ROBOT, 3).causes == frozenset()


@pytest.mark.parametrize("oversampling", [1, 5])
def test_stepped_plant_matches_the_generator(hidden_effects, oversampling):
    case, tick_s = hidden_effects.case, 5e-4
    columns = [list(ROBOT.axes).index(name) for name in case.axis_names]
    time_s = np.arange(2400) * tick_s
    low, high = np.array([ROBOT.axes[name].range for name in case.axis_names]).T
    swing = np.sin(2 * np.pi * np.outer(time_s, [1.1, 2.3, 3.7]))
    commands = low + (high - low) * (0.5 + 0.42 * swing * np.linspace(1.0, 0.3, 2400)[:, None])
    middle = [sum(axis.range) / 2.0 for axis in ROBOT.axes.values()]
    all_commands = np.tile(middle, (len(time_s), 1))
    all_commands[:, columns] = commands
    plant = SteppedPlant(ROBOT, case)
    state = plant.find_rest_state(0.0, all_commands[0])
    position_parts = []
    sampled_commands = np.repeat(all_commands, oversampling, axis=0)
    sampled_s = tick_s + np.arange(len(sampled_commands)) * tick_s / oversampling
    for first in range(0, len(sampled_commands), 37 * oversampling):
        part = slice(first, first + 37 * oversampling)
        random_streams = RandomStreams(np.random.default_rng(0))
        motion, state = plant.advance(
            state, sampled_s[part], sampled_commands[part], random_streams=random_streams
        )
        position_parts.append(motion.position[::oversampling, columns])
    run = case.machine.respond(SampledCommands(tick_s, commands), 0)
    settled_deviation = np.abs(np.concatenate(position_parts) - run.motion)[800:]
    max_deviation = settled_deviation.max(axis=0)
    assert (max_deviation < 1e-3 * np.array([axis.floor for axis in case.machine.axes])).all()


def test_hidden_machine_plays_without_revealing_its_effects(hidden_effects):
    session, events, step = start_hidden_session(hidden_effects)
    session.play(make_demonstration(ROBOT))
    step()
    while step().activity is not DeviceState.IDLE:
        pass
    (finished,) = [event for event in events if isinstance(event, PlaybackFinished)]
    record = finished.record
    assert record.metadata["driver"] == "hidden machine"
    assert session.service.effects == ()
    metadata_text = " ".join([*record.metadata, *record.metadata.values()])
    assert not any(effect in metadata_text for _, effect in hidden_effects.causes)
    gap = record.signal("zn", Tap.MEAS) - record.signal("zn", Tap.CMD)
    assert np.abs(gap).max() < 1e-5  # it follows
    session.service.set_effects([AxisEffect(axis="zn", id="creep")])
    step()
    assert any(isinstance(e, CommandRefused) and "reveal it first" in e.message for e in events)


def test_diagnosis_is_right_only_if_causes_match_exactly(hidden_effects):
    causes = hidden_effects.causes
    assert is_diagnosis_right(hidden_effects, causes)
    assert not is_diagnosis_right(hidden_effects, [*causes, ("x", "friction")])
    assert not is_diagnosis_right(hidden_effects, [])
    assert is_diagnosis_right(HiddenEffects(1, None), [])
