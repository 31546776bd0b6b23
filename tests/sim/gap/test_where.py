"""Where the gap lies: taps, stages, bands and regimes of known causes."""

import numpy as np
import pytest

from rotemina.sim.effects.formulation import Stage
from rotemina.sim.gap.bands import spectrum
from rotemina.sim.gap.blocks import Blocks, block_numbers, drawn_means, summed
from rotemina.sim.gap.evidence import Evidence
from rotemina.sim.gap.regimes import Regime, regimes
from rotemina.sim.gap.where import locate
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")


def stairs(axis, share, rate_hz=1000.0, holds=12, hold_s=0.5):
    """Smooth steps up and down, with holds between."""
    own = ROBOT.axes[axis]
    time_s = np.arange(round(holds * hold_s * rate_hz)) / rate_hz
    phase = time_s / hold_s
    level = np.minimum(np.floor(phase), holds - 1)
    ramp = np.clip((phase - level) / 0.3, 0.0, 1.0)
    smooth = ramp * ramp * (3.0 - 2.0 * ramp)
    path = np.cumsum(np.concatenate([[0.0], np.where(np.arange(holds) % 6 < 3, 1.0, -1.0)]))
    at = level.astype(int)
    command = path[at] + (path[at + 1] - path[at]) * smooth
    return Record.from_signals(
        time_s,
        {(axis, Tap.CMD): sum(own.range) / 2 + share * own.span * command},
        {axis: own.unit},
    )


def places(effects, axis, share, seed=0):
    record = simulate(ROBOT, effects, stairs(axis, share), np.random.default_rng(seed))
    found = locate(Evidence.of(ROBOT, axis, [record]), np.random.default_rng(1))
    return {place.tap: place for place in found}


def test_a_healthy_axis_has_no_significant_gap():
    for axis, share in (("x", 1e-3), ("thx", 0.1), ("zn", 0.1)):
        for seed in range(4):
            for place in places([], axis, share, seed).values():
                if place.tap is not Tap.U:
                    assert place.excess < 0.2, (axis, seed, place.tap)


def test_an_actuators_effect_is_seen_at_both_taps_of_the_position():
    found = places([AxisEffect(axis="zn", id="hysteresis")], "zn", 0.1)
    assert found[Tap.REF].significant
    assert found[Tap.REF].stage is Stage.ACTUATOR
    assert found[Tap.MEAS].significant
    assert found[Tap.REF].excess > found[Tap.MEAS].excess  # the reference is less noisy


def test_a_sensors_effect_leaves_the_reference_alone():
    bent = AxisEffect(axis="zn", id="sensor_gain", parameters={"error": 0.03})
    found = places([bent], "zn", 0.1)
    assert not found[Tap.REF].significant
    assert found[Tap.MEAS].significant
    assert found[Tap.MEAS].stage is Stage.SENSOR


def test_a_vibration_is_found_in_its_band():
    tone = AxisEffect(
        axis="zn", id="vibration", parameters={"frequency": 37.0, "sine": 3e-7, "cosine": 0.0}
    )
    low, high = places([tone], "zn", 0.1)[Tap.REF].worst_band_hz
    assert low <= 37.0 <= high
    assert high < 4 * low


def test_backlash_is_found_after_reversals_and_a_delay_under_way():
    late = AxisEffect(axis="x", id="delay", parameters={"delay": 4e-3})
    found = places([late], "x", 1e-3)[Tap.REF]
    assert found.by_regime[Regime.REST] < 1.0 < found.by_regime[Regime.FAST]


def test_regimes_of_a_ramp_with_a_turn_and_a_rest():
    time_s = np.arange(1000) / 1000.0
    command = np.interp(time_s, [0.0, 0.3, 0.6, 1.0], [0.0, 1.0, 0.0, 0.0])
    found = regimes(time_s, command, np.zeros(1000, dtype=bool))
    assert found[Regime.FORWARD][100]
    assert found[Regime.BACKWARD][500]
    assert found[Regime.REVERSAL][310]
    assert not found[Regime.REVERSAL][400]
    assert found[Regime.SETTLING][650]
    assert found[Regime.REST][800]
    other = regimes(time_s, command, np.ones(1000, dtype=bool))
    assert other[Regime.OTHER_AXIS][800]


def test_a_hold_is_one_block_however_long():
    time_s = np.arange(2000) / 1000.0
    command = np.where(time_s < 1.0, 0.0, time_s - 1.0)
    numbers = block_numbers(time_s, command)
    assert len(np.unique(numbers[:1000])) == 1
    assert len(np.unique(numbers[1001:])) in (4, 5)


def test_drawn_means_spread_as_the_blocks_do():
    rng = np.random.default_rng(0)
    values = rng.normal(3.0, 1.0, 400)
    blocks = summed(np.arange(400), values[:, None])
    means = drawn_means(blocks, np.random.default_rng(1), draws=2000)
    assert means.mean() == pytest.approx(values.mean(), abs=0.02)
    assert means.std() == pytest.approx(values.std() / 20.0, rel=0.1)
    assert isinstance(blocks, Blocks)


def test_white_noise_at_its_floor_has_no_power_above_it():
    time_s = np.arange(20000) / 1000.0
    own = spectrum(time_s, np.random.default_rng(2).standard_normal(20000))
    assert own.power.sum() < 0.2


def test_uneven_samples_tell_no_spectrum():
    time_s = np.cumsum(np.random.default_rng(3).uniform(0.5, 1.5, 500)) * 1e-3
    assert spectrum(time_s, np.ones(500)) is None
