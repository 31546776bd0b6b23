"""Effects in the simulation: beside the same loop in C, beside real time, and one by one.

Limits: six axes with hysteresis (10 plays), creep, friction and a further mode each, recorded at
2 kHz and stepped at 20 kHz, run at least 50 times faster than real time and within 2 times of
reference.c at -O3. One axis with one effect, 10 s at 2 kHz: 5 ms without inner steps, 50 ms with.
The first call, with compilation, 10 s.
"""

import ctypes
import os
import shutil
import subprocess
import sys
import time
from dataclasses import replace
from math import inf
from pathlib import Path
from statistics import median

import numpy as np
import pytest

from rotemina.sim.effects import attachment
from rotemina.sim.effects.formulation import EVERY_KIND
from rotemina.sim.effects.registry import all_effects, effect_named
from rotemina.sim.plant.plant import Plant
from rotemina.sim.plant.state import Behind
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

RATE_HZ, INNER_HZ, SECONDS, ROWS, TURNS = 2000.0, 20_000.0, 20.0, 20_000, 7
FOUR = ("hysteresis", "creep", "friction", "flexible_mode")
ROBOT = load_robot("rotemina")
AXES = tuple(ROBOT.axes)
MOST_TIMES_C = 2.0
QUICK = {"SECONDS": 0.5, "TURNS": 1, "ROWS": 2000, "MOST_TIMES_C": inf}


@pytest.fixture
def whole_plant(monkeypatch):
    """Six axes with all four effects each, whatever kind of axis they are made for."""
    anywhere = {name: replace(effect_named(name), kinds=EVERY_KIND) for name in FOUR}
    monkeypatch.setattr(attachment, "effect_named", anywhere.__getitem__)
    effects = tuple(AxisEffect(axis=axis, id=name) for axis in AXES for name in FOUR)
    plant = Plant.of(replace(ROBOT, effects=effects))
    # Friction asks for steps of its own choice: here they are those of the measure.
    assembly = replace(plant.assembly, inner_step_s=1.0 / INNER_HZ)
    return replace(plant, assembly=assembly)


def wave(rows, share=0.05):
    time_s = np.arange(rows) / RATE_HZ
    spans = np.array([axis.span for axis in ROBOT.axes.values()])
    centres = np.array([sum(axis.range) / 2 for axis in ROBOT.axes.values()])
    sines = np.sin(2 * np.pi * np.outer(time_s, [1.0, 1.5, 2.0, 3.0, 4.0, 5.0]))
    return time_s, centres + share * spans * sines


@pytest.mark.skipif(shutil.which("cc") is None, reason="needs a C compiler, cc")
def test_six_axes_beside_c_and_real_time(whole_plant, tmp_path):
    plant = whole_plant
    time_s, command = wave(round(SECONDS * RATE_HZ))
    start = plant.at_rest(0.0, command[0])
    c_run = c_reference(plant, start, time_s, command, tmp_path)

    def ours():
        return plant.advance(start, time_s, command)[0].position

    spans = np.array([axis.span for axis in ROBOT.axes.values()])
    assert (np.abs(ours() - c_run()) / spans).max() < 1e-9
    seconds = {"ours": [], "c": []}
    for _ in range(TURNS):
        for name, run in (("ours", ours), ("c", c_run)):
            begin = time.thread_time()
            run()
            seconds[name].append(time.thread_time() - begin)
    ratios = [a / b for a, b in zip(seconds["ours"], seconds["c"], strict=True)]
    faster = [SECONDS / own for own in seconds["ours"]]
    print(
        f"\nsix axes, four effects each, {SECONDS:g} s at 2 kHz / 20 kHz: "
        f"{median(faster):.0f} times real time ({min(faster):.0f} to {max(faster):.0f}; limit 50), "
        f"{median(ratios):.2f} times the time of C at -O3 "
        f"({min(ratios):.2f} to {max(ratios):.2f}, {TURNS} pairs; limit {MOST_TIMES_C:g})"
    )
    assert median(ratios) <= MOST_TIMES_C


def c_reference(plant, start, time_s, command, folder):
    """Build reference.c and return a call of it on these tables and commands."""
    library = folder / "reference.so"
    source = Path(__file__).with_name("reference.c")
    subprocess.run(
        [shutil.which("cc"), "-O3", "-shared", "-fPIC", "-o", str(library), str(source), "-lm"],
        check=True,
    )
    run = ctypes.CDLL(str(library)).run
    run.restype = None
    machine = plant.assembly.machine
    steps = plant.steps(time_s, 0, Behind.COMMAND)
    longest = int(np.argmax(steps.length_s))
    order = [machine.function[c].tolist() for c in ("numbers_at", "memory_at")]
    matrices = [
        (steps.state_at[g] + longest * n * n, steps.input_at[g] + longest * n * (2 * m + 1))
        for g, (n, m) in enumerate(machine.group[["states", "axes"]].tolist())
    ]
    given = [
        len(time_s), int(steps.parts[longest]), 1.0 / RATE_HZ, len(AXES),
        machine.axis["place"], machine.axis["rate"], machine.axis["asked"],
        machine.axis["offset"], np.array(order[0]), np.array(order[1]), machine.numbers,
    ]  # fmt: skip
    group = [machine.group[c] for c in ("first", "states", "axes", "member")]
    outputs = [machine.output[c] for c in ("begin", "end")]
    inputs = plant.open_loop_inputs(command)
    taken = [np.empty(command.shape) for _ in range(3)]
    tables = [
        len(machine.group), *group, machine.member, np.array([m[0] for m in matrices]),
        steps.state, np.array([m[1] for m in matrices]), steps.input, *outputs, machine.state,
        machine.weight, inputs,
    ]  # fmt: skip
    kept = []

    def passed(value):
        if isinstance(value, int):
            return ctypes.c_long(value)
        if isinstance(value, float):
            return ctypes.c_double(value)
        kept.append(np.ascontiguousarray(value))
        return ctypes.c_void_p(kept[-1].ctypes.data)

    before = [passed(value) for value in given]
    behind = [passed(value) for value in (*tables, *taken)]

    def call():
        """Run, and return the positions (n, axes)."""
        moved = [start.memory.copy(), start.x.copy(), np.empty(len(start.x)), np.empty(len(AXES))]
        memory, *states = (ctypes.c_void_p(array.ctypes.data) for array in moved)
        run(*before, memory, *behind, *states)
        return kept[-3]  # what is passed must outlive the call

    return call


def test_one_axis_one_effect():
    lines = []
    for effect in all_effects()[0].values():
        for formulation in effect.formulations:
            kinds = formulation.kinds or effect.kinds
            axis = next((name for name in ("thx", "x") if ROBOT.axes[name].kind in kinds), None)
            if axis is None:
                continue  # for an axis that a force moves, which this robot has not
            asked = AxisEffect(
                axis=axis,
                id=effect.id,
                formulation=formulation.name,
                from_axis="y" if effect.coupled else None,
            )
            lines.append(one_effect(asked))
    slow = sorted((line for line in lines if line[1]), reverse=True)
    quick = sorted((line for line in lines if not line[1]), reverse=True)
    for title, limit_ms, found in (("without", 5, quick), ("with", 50, slow)):
        times_ms = [own for own, *_ in found]
        worst = ", ".join(f"{name} {own:.1f}" for own, _, name in found[:4])
        print(
            f"\none axis, one effect, 10 s, {title} inner steps, ms (limit {limit_ms}): median "
            f"{median(times_ms):.1f}; slowest {worst}"
        )


def one_effect(asked):
    """Return the median time of a run, ms, whether it has inner steps, and the effect's name."""
    time_s, command = wave(ROWS)
    column = AXES.index(asked.axis)
    commands = Record.from_signals(
        time_s,
        {(asked.axis, Tap.CMD): command[:, column]},
        {asked.axis: ROBOT.axes[asked.axis].unit},
    )
    names = {asked.axis, asked.from_axis}
    alone = replace(
        ROBOT,
        axes={name: axis for name, axis in ROBOT.axes.items() if name in names},
        couplings=(),
        stages={},
    )
    plant = Plant.of(replace(alone, effects=(asked,)))
    seconds = []
    simulate(alone, [asked], commands)
    for _ in range(TURNS):
        begin = time.thread_time()
        simulate(alone, [asked], commands)
        seconds.append(time.thread_time() - begin)
    inner = plant.assembly.inner_step_s < 0.999 / RATE_HZ
    return 1e3 * median(seconds), inner, f"{asked.id}/{asked.formulation}"


def test_first_call(tmp_path):
    """The first simulation ever on a machine, with compilation, and the first of a process."""
    code = (
        "import time, numpy as np\n"
        "from rotemina.sim.robot.file import load_robot\n"
        "from rotemina.sim.robot.model import AxisEffect\n"
        "from rotemina.sim.records.record import Record, Tap\n"
        "from rotemina.sim.simulation.simulation import simulate\n"
        "begin = time.perf_counter()\n"
        "time_s = np.arange(1000) / 1000.0\n"
        "record = Record.from_signals(time_s, {('thx', Tap.CMD): 5e-4 + 0 * time_s},"
        " {'thx': 'rad'})\n"
        "simulate(load_robot('rotemina'), [AxisEffect(axis='thx', id='hysteresis')], record)\n"
        "print(time.perf_counter() - begin)\n"
    )
    seconds = []
    for _ in range(2):
        done = subprocess.run(
            [sys.executable, "-c", code],
            env={**os.environ, "NUMBA_CACHE_DIR": str(tmp_path)},
            capture_output=True,
            text=True,
            check=True,
        )
        seconds.append(float(done.stdout))
    print(
        f"\nfirst simulation with an effect: {seconds[0]:.1f} s with compilation (limit 10), "
        f"{seconds[1]:.2f} s with a kept one"
    )
