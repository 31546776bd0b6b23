"""Machines to compensate: the robot with effects, and one whose equations no inverse shares."""

from typing import NamedTuple

import numpy as np
import pytest

from rotemina.sim.blind.actuator import creep, hysteresis
from rotemina.sim.blind.machine import Commands, machine_of
from rotemina.sim.compensate.anfis import Settings
from rotemina.sim.compensate.samples import Samples, samples_of
from rotemina.sim.compensate.training import train
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate
from rotemina.sim.stops import stops

ROBOT = load_robot("rotemina")
RATE_HZ = 2000.0
WIDTH, CREEP = 0.12, 0.02  # of the range, of a move per decade of time


class Plant(NamedTuple):
    """An axis of a machine, and what it records when it is commanded (cmd, ref, meas)."""

    axis: str
    record: object

    def samples(self, commands):
        return samples_of(ROBOT, self.axis, self.record(commands, 1), "made")

    def tracked(self, inverse, shares):
        """Return error (n,) of the true motion over desired ``shares`` (n,) of the range."""
        axis = ROBOT.axes[self.axis]
        desired = axis.range[0] + axis.span * shares
        time_s = np.arange(len(shares)) / RATE_HZ
        signals = {(self.axis, Tap.CMD): inverse.reset().run(desired)}
        commands = Record.from_signals(time_s, signals, {self.axis: ROBOT.unit(self.axis)})
        return (self.record(commands, 2).signal(self.axis, Tap.REF) - desired) / axis.span


def robot_plant(axis, formulation="prandtl_ishlinskii"):
    width = {"width": WIDTH * ROBOT.axes[axis].span}
    effects = [
        AxisEffect(axis=axis, id="hysteresis", formulation=formulation, parameters=width),
        AxisEffect(axis=axis, id="creep", parameters={"rate": CREEP}),
    ]

    def record(commands, seed):
        rng = np.random.default_rng(seed)
        noisy = simulate(ROBOT, effects, commands, rng)
        true = simulate(ROBOT, effects, commands)
        signals = {
            (axis, Tap.CMD): commands.signal(axis, Tap.CMD),
            (axis, Tap.REF): true.signal(axis, Tap.REF),
            (axis, Tap.MEAS): noisy.signal(axis, Tap.MEAS),
        }
        return Record.from_signals(commands.time_s, signals, commands.units)

    return Plant(axis, record)


def foreign_plant(axis, seed):
    """The blind test's generator: a Preisach plane or Maxwell slip, and Kelvin–Voigt creep."""
    nominal = machine_of(ROBOT, [axis], {axis: np.array(ROBOT.axes[axis].range)})
    rng = np.random.default_rng(seed)
    parts = [
        hysteresis(nominal.axes[0], rng).sized(WIDTH),
        creep(nominal.axes[0], rng).sized(CREEP),
    ]
    machine = nominal.having(parts)

    def record(commands, seed):
        command = commands.signal(axis, Tap.CMD)
        answer = machine.respond(Commands(1.0 / RATE_HZ, command[:, None]), seed)
        sensor = ROBOT.axes[axis].sensor
        noisy = answer.reading[:, 0]
        noisy = noisy + np.random.default_rng(seed).normal(0.0, sensor.noise_rms, len(noisy))
        noisy = np.round(noisy / sensor.resolution) * sensor.resolution
        signals = {
            (axis, Tap.CMD): command,
            (axis, Tap.REF): answer.motion[:, 0],
            (axis, Tap.MEAS): noisy,
        }
        return Record.from_signals(commands.time_s, signals, commands.units)

    return Plant(axis, record)


@pytest.fixture(scope="session")
def robot():
    return ROBOT


@pytest.fixture(scope="session")
def make_robot_plant():
    return robot_plant


@pytest.fixture(scope="session")
def make_foreign_plant():
    return foreign_plant


@pytest.fixture(scope="session")
def bent_run():
    """A static axis with a bent loop and a little noise, without creep: quick to make."""
    rng = np.random.default_rng(4)
    rows = 4000
    fading = np.linspace(1.0, 0.1, rows) * np.sin(np.linspace(0.0, 60.0, rows))
    shares = np.clip(0.5 + 0.48 * fading + 0.05 * np.sin(np.linspace(0.0, 500.0, rows)), 0.0, 1.0)
    radii = np.linspace(0.03, 0.45, 8)
    plays = shares[:, None] - stops(shares, radii, np.zeros(8))
    inner = 0.8 * shares + plays @ np.full(8, 0.03)
    rows_late = np.arange(rows) - 0.519  # the held command, and the damping of the nominal axis
    inner = np.interp(rows_late, np.arange(rows), inner)
    answer = inner + 0.1 * inner**2 + rng.normal(0.0, 2e-4, rows)
    return Samples("made", "zn", "m", 1e-3, 65e-6 * shares, 65e-6 * answer)


@pytest.fixture(scope="session")
def trained(bent_run):
    return train(ROBOT, [bent_run], settings=Settings(epochs=4))
