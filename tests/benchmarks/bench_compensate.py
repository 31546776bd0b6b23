"""Inverses: time of a sample, of which the limit is 20 µs, and of a training."""

from math import inf
from time import perf_counter

import numpy as np

from rotemina.sim.compensate.anfis import Settings
from rotemina.sim.compensate.excitation import excitation
from rotemina.sim.compensate.inverse import Inverse
from rotemina.sim.compensate.samples import samples_of
from rotemina.sim.compensate.training import train
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

LIMIT_S = 20e-6
SAMPLES, ROUNDS, EPOCHS = 5000, 7, Settings().epochs
QUICK = {"SAMPLES": 50, "ROUNDS": 1, "EPOCHS": 1, "LIMIT_S": inf}


def test_a_sample_takes_less_than_the_limit() -> None:
    robot = load_robot("rotemina")
    effects = [
        AxisEffect(axis="zn", id="hysteresis", parameters={"width": 0.12 * 65e-6}),
        AxisEffect(axis="zn", id="creep", parameters={"rate": 0.02}),
    ]
    rng = np.random.default_rng(0)
    record = simulate(robot, effects, excitation(robot, "zn", rng), rng)
    begin_s = perf_counter()
    trained = train(robot, [samples_of(robot, "zn", record)], settings=Settings(epochs=EPOCHS))
    rows = len(record.time_s)
    print(f"\ntraining on {rows} rows, all kinds: {perf_counter() - begin_s:.1f} s")
    print(f"µs a sample, alone (limit {1e6 * LIMIT_S:g}) and in a row")
    wanted = 32e-6 + 25e-6 * np.sin(np.linspace(0.0, 60.0, SAMPLES))
    for kind, model in trained.models.items():
        inverse = Inverse(model, 5e-4)
        inverse.step(float(wanted[0]))
        rounds = []
        for _ in range(ROUNDS):
            begin_s = perf_counter()
            for value in wanted.tolist():
                inverse.step(value)
            rounds.append((perf_counter() - begin_s) / SAMPLES)
        begin_s = perf_counter()
        inverse.reset().run(wanted)
        each_s = (perf_counter() - begin_s) / SAMPLES
        print(f"{kind:27} {1e6 * np.median(rounds):4.1f} {1e6 * each_s:7.2f}")
        assert np.median(rounds) <= LIMIT_S
