"""A diagnosis made by hand, of records whose cause is known."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.gap.diagnosis import (
    AxisDiagnosis,
    Cause,
    Diagnosis,
    Experiment,
    FittedParameter,
    Ranked,
    Shrinkage,
    ShrinkageStep,
    Untestable,
    Verdict,
)
from rotemina.sim.gap.evidence import Evidence
from rotemina.sim.gap.where import locate
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")
LOOP = AxisEffect(axis="thx", id="hysteresis", parameters={"width": 1.2e-4})
RATE_HZ = 500.0


def swings(seed, seconds=4.0):
    """θx swings through several amplitudes; y follows a slow path."""
    time_s = np.arange(round(seconds * RATE_HZ)) / RATE_HZ
    rng = np.random.default_rng(seed)
    own, other = ROBOT.axes["thx"], ROBOT.axes["y"]
    waves = sum(
        size * np.sin(2 * np.pi * rate * time_s + rng.uniform(0, 6))
        for size, rate in ((0.15, 0.7), (0.1, 2.1), (0.03, 11.0))
    )
    return Record.from_signals(
        time_s,
        {
            ("thx", Tap.CMD): sum(own.range) / 2 + own.span * waves,
            ("y", Tap.CMD): sum(other.range) / 2 + 1e-4 * np.sin(2 * np.pi * 0.5 * time_s),
        },
        {"thx": own.unit, "y": other.unit},
        {"operator": "A & B <b>"},
    )


@pytest.fixture(scope="session")
def records():
    """Two records of a robot with hysteresis on θx."""
    return tuple(
        simulate(ROBOT, [LOOP], swings(seed), np.random.default_rng(seed)) for seed in (1, 2)
    )


@pytest.fixture(scope="session")
def diagnosis(records):
    """Everything that can be said of them, with figures made up where they do not matter."""

    def places(axis):
        return locate(Evidence.of(ROBOT, axis, records), np.random.default_rng(0))

    cause = Cause(
        axis="thx",
        effect="hysteresis",
        formulation="prandtl_ishlinskii",
        stage="actuator",
        tap=Tap.MEAS,
        from_axis=None,
        probability=0.913,
        ambiguous_with=("creep",),
        gap_before=3.21e-5,
        gap_after=7.65e-7,
        closed=0.9876,
        closed_interval=(0.971, 0.992),
        parameters=(FittedParameter("width", 1.234e-4, "rad", (1.1e-4, 1.3e-4), "high"),),
    )
    shrinkage = Shrinkage(
        axis="thx",
        tap=Tap.MEAS,
        raw=3.33e-5,
        retuned=3.22e-5,
        corrected=7.77e-7,
        floor=6.66e-7,
        ceiling=7.11e-7,
        closed=0.9753,
        closed_interval=(0.96, 0.98),
        steps=(ShrinkageStep("hysteresis", "thx", 7.88e-7, 0.964),),
    )
    time_s = tuple(np.arange(200) / 100.0)
    wave = np.sin(2 * np.pi * np.arange(200) / 100.0)
    thx = AxisDiagnosis(
        axis="thx",
        verdict=Verdict.EXPLAINED,
        places=places("thx"),
        causes=(cause,),
        shrinkage=(shrinkage,),
        ranking=(
            Ranked("hysteresis", "prandtl_ishlinskii", None, 0.913, 1.21, (1.1, 1.32)),
            Ranked("cross_coupling", None, "y", 0.087, 43.2, (38.0, 47.0)),
        ),
        untestable=(Untestable("sensor_gain", "no reference was measured"),),
        remarks=("The first 0.1 s were left out.",),
        fitted=(replace(LOOP, parameters={"width": 1.234e-4}),),
    )
    experiment = Experiment(
        axis="thx",
        splits=("hysteresis", "creep"),
        why="A long hold after a step parts them.",
        time_s=time_s,
        commands={"thx": tuple(5e-4 + 1e-4 * wave)},
        predictions={
            "hysteresis": tuple(5e-4 + 1e-4 * wave),
            "creep": tuple(5e-4 + 1.1e-4 * wave),
        },
    )
    return Diagnosis(
        ROBOT,
        {"thx": thx, "y": AxisDiagnosis("y", Verdict.NONE, places("y"))},
        (experiment,),
        seed=7,
    )
