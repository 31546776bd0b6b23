"""Machines to compensate: the robot with effects, and one whose equations no inverse has."""

from typing import NamedTuple

import numpy as np
import pytest

from rotemina.sim.blind import build_machine
from rotemina.sim.blind.actuator import draw_creep, draw_hysteresis
from rotemina.sim.blind.machine import SampledCommands
from rotemina.sim.compensate import (
    InverseModel,
    TrainingSamples,
    compute_stops,
    read_samples,
    train,
)
from rotemina.sim.compensate.anfis import AnfisSettings
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")
RATE_HZ = 2000.0
# Hysteresis width as a share of the range, creep as a share of a move per decade of time.
WIDTH, CREEP = 0.12, 0.02


class Plant(NamedTuple):
    """An axis of a machine, and a function that returns its record (cmd, ref, meas) of commands."""

    # A record of the commands, given the commands and a seed.

    axis: str
    record: object

    def read_samples(self, commands):
        return read_samples(ROBOT, self.axis, self.record(commands, 1), "made")

    def compute_tracking_error(self, inverse, shares):
        """Return the error (n,) of the true motion if ``shares`` (n,) of the range are desired."""
        axis = ROBOT.axes[self.axis]
        desired = axis.range[0] + axis.span * shares
        time_s = np.arange(len(shares)) / RATE_HZ
        signals = {(self.axis, Tap.CMD): inverse.reset().run(desired)}
        commands = Record.from_signals(time_s, signals, {self.axis: ROBOT.unit(self.axis)})
        return (self.record(commands, 2).signal(self.axis, Tap.REF) - desired) / axis.span


def build_robot_plant(axis, formulation="prandtl_ishlinskii"):
    width_parameter = {"width": WIDTH * ROBOT.axes[axis].span}
    effects = [
        AxisEffect(axis=axis, id="hysteresis", formulation=formulation, parameters=width_parameter),
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


def build_foreign_plant(axis, seed):
    """Return a machine of the blind generator with Preisach or Maxwell hysteresis, and creep."""
    nominal = build_machine(ROBOT, [axis], {axis: np.array(ROBOT.axes[axis].range)})
    rng = np.random.default_rng(seed)
    parts = [
        draw_hysteresis(nominal.axes[0], rng).with_size(WIDTH),
        draw_creep(nominal.axes[0], rng).with_size(CREEP),
    ]
    machine = nominal.with_parts(parts)

    def record(commands, seed):
        command = commands.signal(axis, Tap.CMD)
        response = machine.respond(SampledCommands(1.0 / RATE_HZ, command[:, None]), seed)
        sensor = ROBOT.axes[axis].sensor
        reading = response.reading[:, 0]
        reading = reading + np.random.default_rng(seed).normal(0.0, sensor.noise_rms, len(reading))
        reading = np.round(reading / sensor.resolution) * sensor.resolution
        signals = {
            (axis, Tap.CMD): command,
            (axis, Tap.REF): response.motion[:, 0],
            (axis, Tap.MEAS): reading,
        }
        return Record.from_signals(commands.time_s, signals, commands.units)

    return Plant(axis, record)


@pytest.fixture(scope="session")
def robot():
    return ROBOT


@pytest.fixture(scope="session")
def make_inverse_model():
    """Return a function that returns an inverse for zn made of two plays, with changed fields."""

    def make(**changes):
        fields = {
            "axis": "zn",
            "unit": "m",
            "kind": "prandtl_ishlinskii",
            "sample_s": 1e-3,
            "origin": 0.0,
            "command_origin": 0.0,
            "span": 65e-6,
            "desired_range": (2e-6, 60e-6),
            "command_range": (0.0, 65e-6),
            "speed": 1.0,
            "consequents": np.array([[0.0, 0.9, 0.1, 0.05]]),
            "radii": np.array([0.1, 0.03]),
            "initial": np.zeros(2),
        }
        return InverseModel(**(fields | changes))

    return make


@pytest.fixture(scope="session")
def make_robot_plant():
    return build_robot_plant


@pytest.fixture(scope="session")
def make_foreign_plant():
    return build_foreign_plant


@pytest.fixture(scope="session")
def bent_run():
    """Samples of a static axis with a curved hysteresis loop and little noise, without creep."""
    rng = np.random.default_rng(4)
    rows = 4000
    decaying_sine = np.linspace(1.0, 0.1, rows) * np.sin(np.linspace(0.0, 60.0, rows))
    shares = np.clip(
        0.5 + 0.48 * decaying_sine + 0.05 * np.sin(np.linspace(0.0, 500.0, rows)), 0.0, 1.0
    )
    radii = np.linspace(0.03, 0.45, 8)
    plays = shares[:, None] - compute_stops(shares, radii, np.zeros(8))
    inner = 0.8 * shares + plays @ np.full(8, 0.03)
    # Delay in samples: half of one for the held command, the rest for the damping of the axis.
    delayed_rows = np.arange(rows) - 0.519
    inner = np.interp(delayed_rows, np.arange(rows), inner)
    response = inner + 0.1 * inner**2 + rng.normal(0.0, 2e-4, rows)
    return TrainingSamples("made", "zn", "m", 1e-3, 65e-6 * shares, 65e-6 * response)


@pytest.fixture(scope="session")
def trained(bent_run):
    return train(ROBOT, [bent_run], settings=AnfisSettings(epochs=4))
