"""Inverses: time of a sample (limit 20 µs) and of a training."""

from math import inf
from time import perf_counter

import numpy as np

from rotemina.sim.compensate import Inverse, make_excitation, read_samples, train
from rotemina.sim.compensate.anfis import AnfisSettings
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

LIMIT_S = 20e-6
SAMPLES, ROUNDS, EPOCHS = 5000, 7, AnfisSettings().epochs
QUICK = {"SAMPLES": 50, "ROUNDS": 1, "EPOCHS": 1, "LIMIT_S": inf}


def test_a_sample_takes_less_than_the_limit() -> None:
    robot = load_robot("rotemina")
    effects = [
        AxisEffect(axis="zn", id="hysteresis", parameters={"width": 0.12 * 65e-6}),
        AxisEffect(axis="zn", id="creep", parameters={"rate": 0.02}),
    ]
    rng = np.random.default_rng(0)
    record = simulate(robot, effects, make_excitation(robot, "zn", rng), rng)
    begin_s = perf_counter()
    trained = train(
        robot, [read_samples(robot, "zn", record)], settings=AnfisSettings(epochs=EPOCHS)
    )
    rows = len(record.time_s)
    print(f"\ntraining on {rows} rows, all kinds: {perf_counter() - begin_s:.1f} s")
    print(f"µs per sample, single (limit {1e6 * LIMIT_S:g}) and in a batch")
    desired = 32e-6 + 25e-6 * np.sin(np.linspace(0.0, 60.0, SAMPLES))
    for kind, model in trained.models.items():
        inverse = Inverse(model, 5e-4)
        inverse.step(float(desired[0]))
        sample_times_s = []
        for _ in range(ROUNDS):
            begin_s = perf_counter()
            for value in desired.tolist():
                inverse.step(value)
            sample_times_s.append((perf_counter() - begin_s) / SAMPLES)
        begin_s = perf_counter()
        inverse.reset().run(desired)
        batch_sample_s = (perf_counter() - begin_s) / SAMPLES
        print(f"{kind:27} {1e6 * np.median(sample_times_s):4.1f} {1e6 * batch_sample_s:7.2f}")
        assert np.median(sample_times_s) <= LIMIT_S
