"""Tuning of a loop: its time and its levels.

The search is that of ``rotemina tune``: 50 generations of 60 individuals on nano Z with hysteresis
12 %, creep 2 % per decade and noise; at most 60 s on two cores. Further results are the time of a
sample of the simulated loop and of the live controller, the levels of the recommended point, and
the share of a core that the simulated machine takes in real time with a loop on and off.
"""

import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from math import inf

import numpy as np

from rotemina.drivers.contract import VirtualClock
from rotemina.drivers.simulator import Simulator
from rotemina.sim.feedback import (
    AxisRegulation,
    FeedForward,
    LoopAnalysis,
    SampledController,
    compute_lead_taps,
)
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.tuning import SearchSettings, TuningProblem, make_tuning, run_search
from rotemina.sim.tuning.tuning_scenario import make_step

RATE_HZ, SAMPLE_S = 5000.0, 2e-4
MAX_SEARCH_S, CORES, GENERATIONS = 60.0, 2, 50
HYSTERESIS = AxisEffect(axis="zn", id="hysteresis", parameters={"width": 0.12 * 65e-6})
CREEP = AxisEffect(axis="zn", id="creep", parameters={"rate": 0.02})
ROBOT = replace(load_robot("rotemina"), effects=(HYSTERESIS, CREEP))
# Largest shares of a core: with a live loop, and sample by sample in real time.
MAX_SHARES = (0.2, 1.0)
QUICK = {"GENERATIONS": 2, "MAX_SEARCH_S": inf, "MAX_SHARES": (inf, inf)}


def test_a_search_and_its_recommendation() -> None:
    problem = TuningProblem(ROBOT, "zn", RATE_HZ)
    # The first call loads the compiled code.
    problem.evaluate(problem.gains_of([0.5, 0.05, 0.1, 0.9, 0.8, 0.5]))
    settings = SearchSettings(generations=GENERATIONS)
    begin_s, busy_s = time.perf_counter(), time.process_time()
    with ThreadPoolExecutor(CORES) as pool:
        *_, last = run_search(problem, settings, pool.map)
    duration_s, busy_s = time.perf_counter() - begin_s, time.process_time() - busy_s
    print(
        f"\n{settings.generations} generations of {settings.population}: {duration_s:.1f} s on "
        f"{CORES} cores (limit {MAX_SEARCH_S:g}), {busy_s:.1f} s of processor; "
        f"{len(last.front)} points"
    )
    print("tracking, %; settling, ms; overshoot, %; IAE, nm s; Ms; effort, ranges/s")
    assert duration_s <= MAX_SEARCH_S
    tuning = make_tuning(problem, settings, last)
    for number, point in enumerate(tuning.points):
        figures = point.figures
        if number in (0, tuning.recommended, len(tuning.points) - 1):
            print(
                f"{number:3}: {100 * figures.tracking_rms:.4f} {1e3 * figures.settling_s:.1f} "
                f"{100 * figures.overshoot:.2f} {1e9 * figures.absolute_error:5.2f} "
                f"{figures.peak_sensitivity:.3f} {figures.effort:.2f}"
            )
    stability = LoopAnalysis(problem.loop.sampled_axis).compute_stability(tuning.chosen_point.gains)
    print(
        f"recommended: margins {stability.gain_margin:.2f}, {stability.phase_margin_deg:.0f}°, "
        f"{1e3 * stability.delay_margin_s:.2f} ms; bandwidth {stability.bandwidth_hz:.0f} Hz; "
        "50 µm, worst of 20 seeds: "
        f"{1e9 * compute_positioning_error(problem, tuning.chosen_point.gains):.1f} nm"
    )


def compute_positioning_error(problem: TuningProblem, gains: object) -> float:
    """Return the largest mean error, m, from 80 to 100 ms after the start of a move of 50 µm."""
    axis = problem.loop.robot_axis
    step = make_step(axis, RATE_HZ, 50e-6)
    reference = np.r_[step.reference, np.full(300, step.target)]
    feed_forward = FeedForward(compute_lead_taps(axis, SAMPLE_S)).run(reference)
    window = slice(round((step.begin_s + 0.08) * RATE_HZ), round((step.begin_s + 0.1) * RATE_HZ))
    errors = [
        problem.loop.follow(
            gains, reference, feed=feed_forward, rng=np.random.default_rng(seed)
        ).position
        - reference
        for seed in range(20)
    ]
    return max(abs(float(error[window].mean())) for error in errors)


def test_the_time_of_a_sample() -> None:
    problem = TuningProblem(ROBOT, "zn", RATE_HZ, spread=0.0)
    gains = problem.gains_of([0.5, 0.05, 0.1, 0.9, 0.8, 0.5])
    reference = np.full(50_000, 30e-6)
    problem.loop.follow(gains, reference)
    begin_s = time.perf_counter()
    problem.loop.follow(gains, reference)
    simulated_s = (time.perf_counter() - begin_s) / len(reference)
    controller = SampledController(gains, 1.0 / RATE_HZ, problem.loop.limits)
    controller.start(30e-6)
    begin_s = time.perf_counter()
    for _ in range(50_000):
        controller.step(30e-6, 30e-6)
    live_s = (time.perf_counter() - begin_s) / 50_000
    begin_s = time.perf_counter()
    problem.try_out(gains)
    trial_s = time.perf_counter() - begin_s
    print(
        f"\nper sample: simulated loop {1e6 * simulated_s:.2f} µs, live controller "
        f"{1e6 * live_s:.2f} µs; a trial on step and triangle: {1e3 * trial_s:.1f} ms"
    )


def test_a_live_loop_leaves_most_of_a_core() -> None:
    problem = TuningProblem(ROBOT, "zn", RATE_HZ, spread=0.0)
    gains = problem.gains_of([0.5, 0.05, 0.1, 0.9, 0.8, 0.0])
    clock, duration_s = VirtualClock(), 20.0
    machine = Simulator(ROBOT, clock=clock)
    machine.open()
    clock.advance(0.1)
    machine.read()
    shares = []
    delay = AxisEffect(axis="zn", id="delay", parameters={"delay": 1e-4})
    for loop, effects in (
        (None, ()),
        (AxisRegulation(ROBOT, "zn", gains, RATE_HZ), ()),
        (AxisRegulation(ROBOT, "zn", gains, RATE_HZ), (delay,)),
    ):
        machine.set_effects((*ROBOT.effects, *effects))
        machine.regulate("zn", loop)
        begin_s = time.process_time()
        for number in range(round(duration_s / 0.016)):
            machine.move_to({"zn": 20e-6 if number % 20 < 10 else 40e-6})
            clock.advance(0.016)
            machine.read()
        clock.advance(1.0)
        machine.read()
        shares.append((time.process_time() - begin_s) / duration_s)
    print(
        f"\nsimulated machine, of a core: {shares[0]:.1%}, with a loop at 5 kHz {shares[1]:.1%}, "
        f"also with a delay {shares[2]:.1%}"
    )
    assert all(share < limit for share, limit in zip(shares[1:], MAX_SHARES, strict=True))
