"""Effects in the simulation: compared with the same loop in C and with real time, and one by one.

Limits: six axes with hysteresis (10 plays), creep, friction and a further mode each, recorded at
2 kHz and stepped at 20 kHz, run at least 50 times faster than real time and take at most twice the
time of reference.c at -O3. One axis with one effect, 10 s at 2 kHz: 5 ms without inner steps, 50 ms
with them.
"""

import ctypes
import shutil
import subprocess
import time
from dataclasses import replace
from math import inf
from pathlib import Path
from statistics import median

import numpy as np
import pytest

from rotemina.sim.effects import EVERY_KIND, attachment, load_all_effects, load_effect
from rotemina.sim.plant import ChainPoint, Plant
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

RATE_HZ, INNER_HZ, SECONDS, ROWS, TURNS = 2000.0, 20_000.0, 20.0, 20_000, 7
EFFECT_IDS = ("hysteresis", "creep", "friction", "flexible_mode")
ROBOT = load_robot("rotemina")
AXES = tuple(ROBOT.axes)
MAX_RATIO_TO_C = 2.0
QUICK = {"SECONDS": 0.5, "TURNS": 1, "ROWS": 2000, "MAX_RATIO_TO_C": inf}


@pytest.fixture
def plant_with_all_effects(monkeypatch):
    """Return a plant of six axes with all four effects each, even if unusual for that axis."""
    unrestricted_effects = {
        name: replace(load_effect(name), kinds=EVERY_KIND) for name in EFFECT_IDS
    }
    monkeypatch.setattr(attachment, "load_effect", unrestricted_effects.__getitem__)
    effects = tuple(AxisEffect(axis=axis, id=name) for axis in AXES for name in EFFECT_IDS)
    plant = Plant.of(replace(ROBOT, effects=effects))
    # Friction normally chooses its own step size; here it is that of the benchmark.
    assembly = replace(plant.assembly, inner_step_s=1.0 / INNER_HZ)
    return replace(plant, assembly=assembly)


def make_wave(rows, share=0.05):
    time_s = np.arange(rows) / RATE_HZ
    spans = np.array([axis.span for axis in ROBOT.axes.values()])
    centres = np.array([sum(axis.range) / 2 for axis in ROBOT.axes.values()])
    sines = np.sin(2 * np.pi * np.outer(time_s, [1.0, 1.5, 2.0, 3.0, 4.0, 5.0]))
    return time_s, centres + share * spans * sines


@pytest.mark.skipif(shutil.which("cc") is None, reason="needs a C compiler, cc")
def test_six_axes_compared_with_c_and_real_time(plant_with_all_effects, tmp_path):
    plant = plant_with_all_effects
    time_s, command = make_wave(round(SECONDS * RATE_HZ))
    start = plant.find_rest_state(0.0, command[0])
    run_c = build_c_reference(plant, start, time_s, command, tmp_path)

    def run_ours():
        return plant.advance(start, time_s, command)[0].position

    spans = np.array([axis.span for axis in ROBOT.axes.values()])
    assert (np.abs(run_ours() - run_c()) / spans).max() < 1e-9
    seconds = {"ours": [], "c": []}
    for _ in range(TURNS):
        for name, run in (("ours", run_ours), ("c", run_c)):
            begin = time.thread_time()
            run()
            seconds[name].append(time.thread_time() - begin)
    ratios = [a / b for a, b in zip(seconds["ours"], seconds["c"], strict=True)]
    speed_ratios = [SECONDS / own_s for own_s in seconds["ours"]]
    print(
        f"\nsix axes, four effects each, {SECONDS:g} s at 2 kHz / 20 kHz: "
        f"{median(speed_ratios):.0f} times real time ({min(speed_ratios):.0f} to "
        f"{max(speed_ratios):.0f}; limit 50), "
        f"{median(ratios):.2f} times the time of C at -O3 "
        f"({min(ratios):.2f} to {max(ratios):.2f}, {TURNS} pairs; limit {MAX_RATIO_TO_C:g})"
    )
    assert median(ratios) <= MAX_RATIO_TO_C


def build_c_reference(plant, start, time_s, command, folder):
    """Build reference.c, and return a function that runs it on these tables and commands."""
    library = folder / "reference.so"
    source = Path(__file__).with_name("reference.c")
    subprocess.run(
        [shutil.which("cc"), "-O3", "-shared", "-fPIC", "-o", str(library), str(source), "-lm"],
        check=True,
    )
    run = ctypes.CDLL(str(library)).run
    run.restype = None
    tables = plant.assembly.tables
    steps = plant.make_steps(time_s, 0, ChainPoint.COMMAND)
    longest = int(np.argmax(steps.length_s))
    order = [tables.function[c].tolist() for c in ("numbers_at", "memory_at")]
    matrices = [
        (steps.state_at[g] + longest * n * n, steps.input_at[g] + longest * n * (2 * m + 1))
        for g, (n, m) in enumerate(tables.group[["states", "axes"]].tolist())
    ]
    loop_arguments = [
        len(time_s), int(steps.parts[longest]), 1.0 / RATE_HZ, len(AXES),
        tables.axis["place"], tables.axis["rate"], tables.axis["asked"],
        tables.axis["offset"], np.array(order[0]), np.array(order[1]), tables.numbers,
    ]  # fmt: skip
    group = [tables.group[c] for c in ("first", "states", "axes", "member")]
    outputs = [tables.output[c] for c in ("begin", "end")]
    inputs = plant.compute_open_loop_inputs(command)
    output_arrays = [np.empty(command.shape) for _ in range(3)]
    system_arguments = [
        len(tables.group), *group, tables.member, np.array([m[0] for m in matrices]),
        steps.state, np.array([m[1] for m in matrices]), steps.input, *outputs, tables.state,
        tables.weight, inputs,
    ]  # fmt: skip
    arrays_in_use = []

    def to_ctypes(value):
        if isinstance(value, int):
            return ctypes.c_long(value)
        if isinstance(value, float):
            return ctypes.c_double(value)
        arrays_in_use.append(np.ascontiguousarray(value))
        return ctypes.c_void_p(arrays_in_use[-1].ctypes.data)

    first_arguments = [to_ctypes(value) for value in loop_arguments]
    last_arguments = [to_ctypes(value) for value in (*system_arguments, *output_arrays)]

    def run_loop():
        """Run the loop, and return the positions (n, axes)."""
        state_arrays = [
            start.memory.copy(),
            start.x.copy(),
            np.empty(len(start.x)),
            np.empty(len(AXES)),
        ]
        memory, *states = (ctypes.c_void_p(array.ctypes.data) for array in state_arrays)
        run(*first_arguments, memory, *last_arguments, *states)
        # All arrays that are passed must outlive the call.
        return arrays_in_use[-3]

    return run_loop


def test_one_axis_one_effect():
    results = []
    for effect in load_all_effects()[0].values():
        for formulation in effect.formulations:
            kinds = formulation.kinds or effect.kinds
            axis = next((name for name in ("thx", "x") if ROBOT.axes[name].kind in kinds), None)
            if axis is None:
                # This effect needs a force-driven axis, which the robot does not have.
                continue
            axis_effect = AxisEffect(
                axis=axis,
                id=effect.id,
                formulation=formulation.name,
                from_axis="y" if effect.coupled else None,
            )
            results.append(time_effect(axis_effect))
    slow = sorted((result for result in results if result[1]), reverse=True)
    quick = sorted((result for result in results if not result[1]), reverse=True)
    for title, limit_ms, group in (("without", 5, quick), ("with", 50, slow)):
        times_ms = [time_ms for time_ms, *_ in group]
        worst = ", ".join(f"{name} {time_ms:.1f}" for time_ms, _, name in group[:4])
        print(
            f"\none axis, one effect, 10 s, {title} inner steps, ms (limit {limit_ms}): median "
            f"{median(times_ms):.1f}; slowest {worst}"
        )


def time_effect(effect):
    """Return the median time of a run, ms, whether it has inner steps, and the effect's name."""
    time_s, command = make_wave(ROWS)
    column = AXES.index(effect.axis)
    commands = Record.from_signals(
        time_s,
        {(effect.axis, Tap.CMD): command[:, column]},
        {effect.axis: ROBOT.axes[effect.axis].unit},
    )
    axis_names = {effect.axis, effect.from_axis}
    reduced_robot = replace(
        ROBOT,
        axes={name: axis for name, axis in ROBOT.axes.items() if name in axis_names},
        couplings=(),
        stages={},
    )
    plant = Plant.of(replace(reduced_robot, effects=(effect,)))
    seconds = []
    simulate(reduced_robot, [effect], commands)
    for _ in range(TURNS):
        begin = time.thread_time()
        simulate(reduced_robot, [effect], commands)
        seconds.append(time.thread_time() - begin)
    has_inner_steps = plant.assembly.inner_step_s < 0.999 / RATE_HZ
    return 1e3 * median(seconds), has_inner_steps, f"{effect.id}/{effect.formulation}"
