"""A model that reads in steps as a coarse sensor does: the grid's width and where it lies."""

import numpy as np
import pytest

from rotemina.sim.gap.diagnosis_pipeline import diagnose
from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.gap.noise.coarse_reading import grid_width, steps_of
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")
TIME_S = np.arange(6000) / 1000.0
STEP, SHIFT = 4.3e-7, 0.31
COARSE = AxisEffect(axis="zn", id="sensor_quantization", parameters={"step": STEP, "shift": SHIFT})


def record(effects, hertz, seed):
    path = (32.5 + 18.0 * np.sin(2.0 * np.pi * hertz * TIME_S)) * 1e-6
    command = Record.from_signals(TIME_S, {("zn", Tap.CMD): path}, {"zn": "m"})
    return simulate(ROBOT, effects, command, np.random.default_rng(seed))


@pytest.mark.parametrize("off", [-0.03, 0.0, 0.03])
def test_a_grid_of_a_thousand_steps_is_as_wide_as_it_is(off):
    rng = np.random.default_rng(3)
    way = np.cumsum(rng.normal(0.0, 2.0, 40_000)) * 1e-6
    reading = STEP * (np.rint(way / STEP - SHIFT) + SHIFT) + rng.normal(0.0, 2e-8, len(way))
    assert np.ptp(way) > 800 * STEP
    assert grid_width([reading], STEP * (1.0 + off)) == pytest.approx(STEP, rel=1e-5)


def test_the_corrected_model_reads_in_the_same_steps_on_a_record_that_it_has_not_seen():
    lost = AxisEffect(axis="zn", id="gain_error", parameters={"error": 0.02})
    found = diagnose(ROBOT, [record([COARSE, lost], 0.4, 1), record([COARSE, lost], 0.9, 2)])
    assert {one.effect for one in found.causes} == {"sensor_quantization", "gain_error"}
    (steps,) = [one for one in found.fitted if one.id == "sensor_quantization"]
    assert steps.parameters["step"] == pytest.approx(STEP, rel=1e-4)
    assert steps.parameters["shift"] == pytest.approx(SHIFT, abs=0.05)
    unseen = Evidence.of(ROBOT, "zn", [record([COARSE, lost], 1.7, 3)])
    smooth = [one for one in found.fitted if one is not steps]
    left = np.std(unseen.residual(found.fitted)), np.std(unseen.residual(smooth))
    # Noise of 12 nm takes one reading in ninety over the edge of its step, which none foretells.
    assert left[0] < 0.6 * left[1]


def test_steps_that_the_model_cannot_count_are_left_out():
    seen = Evidence.of(ROBOT, "zn", [record([COARSE], 0.4, 1)])
    assert steps_of(seen, [], STEP) is not None
    shaken = AxisEffect(
        axis="zn", id="vibration", parameters={"frequency": 31.0, "sine": 2e-6, "cosine": 0.0}
    )
    assert steps_of(Evidence.of(ROBOT, "zn", [record([COARSE, shaken], 0.4, 1)]), [], STEP) is None
