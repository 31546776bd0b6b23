"""Commands and simulated records of moving axes."""

import numpy as np

from rotemina.sim.records import Record, Tap
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")


def simulate_sweep(effects, axes=("x",), seconds=8.0, rate_hz=1000.0, share=0.05, seed=0):
    """Return a record of axes that move back and forth at their own rates, from rest to rest."""
    time_s = np.arange(round(seconds * rate_hz)) / rate_hz
    signals, units = {}, {}
    for number, name in enumerate(axes):
        axis = ROBOT.axes[name]
        turn = 0.5 - 0.5 * np.cos(2 * np.pi * (number + 1) * time_s / seconds)
        signals[name, Tap.CMD] = sum(axis.range) / 2 + share * axis.span * turn
        units[name] = axis.unit
    commands = Record.from_signals(time_s, signals, units)
    return simulate(ROBOT, effects, commands, np.random.default_rng(seed))


def simulate_chirps(axis, effects, *shares):
    """Return records of sweeps of increasing frequency, one for each share of the range."""
    description, rng = ROBOT.axes[axis], np.random.default_rng(0)
    time_s = np.arange(6000) / 1000.0
    wave = np.sin(2.0 * np.pi * (0.1 * time_s + 0.05 * time_s**2))
    records = []
    for share in shares:
        command = sum(description.range) / 2 + share * description.span * wave
        record = Record.from_signals(time_s, {(axis, Tap.CMD): command}, {axis: description.unit})
        records.append(simulate(ROBOT, effects, record, rng))
    return records


def make_triangles_and_steps(axis, share=0.1):
    """Return commands of 8 s at 1 kHz: constant speeds, then steps with holds between them."""
    description, time_s = ROBOT.axes[axis], np.arange(8000) / 1000.0
    wave = 2.0 / np.pi * np.arcsin(np.sin(2.0 * np.pi * 0.5 * time_s))
    stairs = np.floor(time_s) % 3 - 1.0
    path = np.where(time_s < 4.0, wave, 0.3 * stairs)
    command = sum(description.range) / 2 + share * description.span * path
    return Record.from_signals(time_s, {(axis, Tap.CMD): command}, {axis: description.unit})


def make_sines(axes=("zn",), share=0.2):
    """Return commands of 4 s: growing sines around the middle of the range, ever slower ones."""
    time_s = np.arange(4000) / 1000.0
    signals = {}
    for number, axis in enumerate(axes):
        description = ROBOT.axes[axis]
        wave = np.minimum(time_s, 1.0) * np.sin(2.0 * np.pi * 0.7**number * time_s)
        signals[axis, Tap.CMD] = sum(description.range) / 2.0 + share * description.span * wave
    return Record.from_signals(time_s, signals, {axis: ROBOT.unit(axis) for axis in axes})


def simulate_effort(robot, command):
    """Return the noisy effort of the force-driven axis q under its controller, at 1 kHz."""
    time_s, units, metadata = np.arange(len(command)) * 1e-3, {"q": "m"}, {"mode": "closed_loop"}
    commands = Record.from_signals(time_s, {("q", Tap.CMD): command}, units, metadata)
    response = simulate(robot, robot.effects, commands)
    noise = 3e-3 * np.random.default_rng(0).standard_normal(len(command))
    signals = {("q", Tap.CMD): command, ("q", Tap.U): response.signal("q", Tap.U) + noise}
    return Record.from_signals(time_s, signals, units, metadata)
