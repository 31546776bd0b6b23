"""A model with the quantized reading of a coarse sensor: width and shift of the grid."""

import numpy as np
import pytest

from rotemina.sim.gap.fit import Evidence
from rotemina.sim.gap.noise import steps_of
from rotemina.sim.gap.noise.reading_step_effect import grid_width
from rotemina.sim.gap.pipeline import diagnose
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")
TIME_S = np.arange(6000) / 1000.0
STEP, SHIFT = 4.3e-7, 0.31
COARSE = AxisEffect(axis="zn", id="sensor_quantization", parameters={"step": STEP, "shift": SHIFT})


def simulate_record(effects, hertz, seed):
    path = (32.5 + 18.0 * np.sin(2.0 * np.pi * hertz * TIME_S)) * 1e-6
    command = Record.from_signals(TIME_S, {("zn", Tap.CMD): path}, {"zn": "m"})
    return simulate(ROBOT, effects, command, np.random.default_rng(seed))


@pytest.mark.parametrize("start_error", [-0.03, 0.0, 0.03])
def test_the_width_of_a_grid_of_a_thousand_steps_is_found_exactly(start_error):
    rng = np.random.default_rng(3)
    path = np.cumsum(rng.normal(0.0, 2.0, 40_000)) * 1e-6
    reading = STEP * (np.rint(path / STEP - SHIFT) + SHIFT) + rng.normal(0.0, 2e-8, len(path))
    assert np.ptp(path) > 800 * STEP
    assert grid_width([reading], STEP * (1.0 + start_error)) == pytest.approx(STEP, rel=1e-5)


def test_the_corrected_model_reads_in_the_same_steps_on_an_unseen_record():
    gain_error = AxisEffect(axis="zn", id="gain_error", parameters={"error": 0.02})
    diagnosis = diagnose(
        ROBOT,
        [
            simulate_record([COARSE, gain_error], 0.4, 1),
            simulate_record([COARSE, gain_error], 0.9, 2),
        ],
    )
    assert {cause.effect for cause in diagnosis.causes} == {"sensor_quantization", "gain_error"}
    (cause,) = [cause for cause in diagnosis.causes if cause.effect == "sensor_quantization"]
    assert cause.gap_before == pytest.approx(STEP / np.sqrt(12.0), rel=0.1)
    (quantization,) = [effect for effect in diagnosis.fitted if effect.id == "sensor_quantization"]
    assert quantization.parameters["step"] == pytest.approx(STEP, rel=1e-4)
    assert quantization.parameters["shift"] == pytest.approx(SHIFT, abs=0.05)
    unseen_evidence = Evidence.of(ROBOT, "zn", [simulate_record([COARSE, gain_error], 1.7, 3)])
    other_effects = [effect for effect in diagnosis.fitted if effect is not quantization]
    residual_rms = (
        np.std(unseen_evidence.residual(diagnosis.fitted)),
        np.std(unseen_evidence.residual(other_effects)),
    )
    # Noise of 12 nm moves one of ninety readings to another step, which no model predicts.
    assert residual_rms[0] < 0.6 * residual_rms[1]


def test_steps_that_the_model_cannot_predict_are_omitted():
    evidence = Evidence.of(ROBOT, "zn", [simulate_record([COARSE], 0.4, 1)])
    assert steps_of(evidence, [], STEP) is not None
    vibration = AxisEffect(
        axis="zn", id="vibration", parameters={"frequency": 31.0, "sine": 2e-6, "cosine": 0.0}
    )
    assert (
        steps_of(Evidence.of(ROBOT, "zn", [simulate_record([COARSE, vibration], 0.4, 1)]), [], STEP)
        is None
    )
