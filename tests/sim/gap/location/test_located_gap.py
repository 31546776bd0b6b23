"""Location of the gap: taps, stages, bands and regimes of known causes."""

import numpy as np
import pytest

from rotemina.sim.effects import EffectStage
from rotemina.sim.gap.fit import Evidence
from rotemina.sim.gap.location import (
    GapPortion,
    LocatedGap,
    OperatingRegime,
    locate_gap,
)
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")


def make_steps(axis, share, rate_hz=1000.0, holds=12, hold_s=0.5):
    """Return smooth steps up and down, with holds between them."""
    description = ROBOT.axes[axis]
    time_s = np.arange(round(holds * hold_s * rate_hz)) / rate_hz
    phase = time_s / hold_s
    level = np.minimum(np.floor(phase), holds - 1)
    ramp = np.clip((phase - level) / 0.3, 0.0, 1.0)
    smooth = ramp * ramp * (3.0 - 2.0 * ramp)
    levels = np.cumsum(np.concatenate([[0.0], np.where(np.arange(holds) % 6 < 3, 1.0, -1.0)]))
    index = level.astype(int)
    command = levels[index] + (levels[index + 1] - levels[index]) * smooth
    return Record.from_signals(
        time_s,
        {(axis, Tap.CMD): sum(description.range) / 2 + share * description.span * command},
        {axis: description.unit},
    )


def locate_gaps(effects, axis, share, seed=0):
    record = simulate(ROBOT, effects, make_steps(axis, share), np.random.default_rng(seed))
    gaps = locate_gap(Evidence.of(ROBOT, axis, [record]), np.random.default_rng(1))
    return {gap.tap: gap for gap in gaps}


def test_a_healthy_axis_has_no_significant_gap():
    for axis, share in (("x", 1e-3), ("thx", 0.1), ("zn", 0.1)):
        for seed in range(2):
            for gap in locate_gaps([], axis, share, seed).values():
                if gap.tap is not Tap.U:
                    assert gap.excess < 0.2, (axis, seed, gap.tap)


def test_an_effect_of_the_actuator_appears_at_both_taps_and_one_of_the_sensor_at_its_own():
    gaps = locate_gaps([AxisEffect(axis="zn", id="hysteresis")], "zn", 0.1)
    assert gaps[Tap.REF].is_significant
    assert gaps[Tap.REF].stage is EffectStage.ACTUATOR
    assert gaps[Tap.MEAS].is_significant
    # The reference has less noise.
    assert gaps[Tap.REF].excess > gaps[Tap.MEAS].excess
    sensor_gain = AxisEffect(axis="zn", id="sensor_gain", parameters={"error": 0.03})
    gaps = locate_gaps([sensor_gain], "zn", 0.1)
    assert not gaps[Tap.REF].is_significant
    assert gaps[Tap.MEAS].is_significant
    assert gaps[Tap.MEAS].stage is EffectStage.SENSOR


def test_a_vibration_is_found_in_its_band():
    vibration = AxisEffect(
        axis="zn", id="vibration", parameters={"frequency": 37.0, "sine": 3e-7, "cosine": 0.0}
    )
    low, high = locate_gaps([vibration], "zn", 0.1)[Tap.REF].worst_band_hz
    assert low <= 37.0 <= high
    assert high < 4 * low


def test_a_delay_is_found_during_motion_and_not_at_rest():
    delay = AxisEffect(axis="x", id="delay", parameters={"delay": 4e-3})
    gap = locate_gaps([delay], "x", 1e-3)[Tap.REF]
    assert (
        gap.by_regime[OperatingRegime.REST].excess
        < 1.0
        < gap.by_regime[OperatingRegime.FAST].excess
    )


def test_hysteresis_is_larger_on_large_oscillations_than_on_small_ones():
    def make_oscillations(amplitude):
        time_s = np.arange(6000) / 1000.0
        wave = 2.0 / np.pi * np.arcsin(np.sin(2.0 * np.pi * time_s))
        return amplitude * np.where(time_s < 3.0, 1.0, 0.2) * wave

    axis = ROBOT.axes["zn"]
    command = sum(axis.range) / 2 + make_oscillations(0.3 * axis.span)
    record = Record.from_signals(np.arange(6000) / 1000.0, {("zn", Tap.CMD): command}, {"zn": "m"})
    hysteresis = AxisEffect(axis="zn", id="hysteresis", parameters={"shape": 1.5})
    simulated_record = simulate(ROBOT, [hysteresis], record, np.random.default_rng(0))
    (meas_gap,) = (
        gap
        for gap in locate_gap(
            Evidence.of(ROBOT, "zn", [simulated_record]), np.random.default_rng(1)
        )
        if gap.tap is Tap.MEAS
    )
    large, small = (
        meas_gap.by_regime[OperatingRegime.LARGE_SWING],
        meas_gap.by_regime[OperatingRegime.SMALL_SWING],
    )
    assert large.excess > 4.0 * small.excess
    assert large.share + small.share == pytest.approx(1.0, abs=0.01)
    low, high = large.share_interval
    assert low <= large.share <= high
    assert sum(portion.share for portion in meas_gap.by_band.values()) == pytest.approx(
        1.0, abs=0.02
    )


def test_uneven_samples_have_no_bands():
    rng = np.random.default_rng(3)
    time_s = np.cumsum(rng.uniform(0.5, 1.5, 500)) * 1e-3
    command = 3e-5 + 1e-5 * np.sin(20.0 * time_s)
    reading = 1.1 * command + 1e-9 * rng.standard_normal(500)
    signals = {("zn", Tap.CMD): command, ("zn", Tap.MEAS): reading}
    record = Record.from_signals(time_s, signals, {"zn": "m"})
    (gap,) = locate_gap(Evidence.of(ROBOT, "zn", [record]), rng)
    assert gap.is_significant
    assert gap.by_band == {}
    assert gap.worst_band_hz is None


def test_a_gap_at_a_single_time_is_sudden_but_not_significant():
    rng = np.random.default_rng(4)
    time_s = np.arange(6000) / 1000.0
    command = np.where(time_s < 2.0, 3e-5, 3.2e-5)
    floor = ROBOT.axes["zn"].sensor.noise_floor
    commands = Record.from_signals(time_s, {("zn", Tap.CMD): command}, {"zn": "m"})
    undisturbed = simulate(ROBOT, [], commands, rng).signal("zn", Tap.MEAS)
    disturbed = undisturbed + 200.0 * floor * ((time_s > 2.0) & (time_s < 2.1)) * np.sin(
        900.0 * time_s
    )
    for reading, sudden in ((undisturbed, False), (disturbed, True)):
        signals = {("zn", Tap.CMD): command, ("zn", Tap.MEAS): reading}
        record = Record.from_signals(time_s, signals, {"zn": "m"})
        (gap,) = locate_gap(Evidence.of(ROBOT, "zn", [record]), rng)
        assert not gap.is_significant
        assert gap.is_sudden is sudden


def test_a_rare_regime_is_not_named_as_the_worst():
    def make_gap(rows):
        """Return a gap of 10 floors², three times as large in a small share of the rows."""
        portions = {
            OperatingRegime.FAST: GapPortion(0.9, (0.8, 1.0), 9.0),
            OperatingRegime.REVERSAL: GapPortion(3.0 * rows, (0.0, 1.0), 30.0),
        }
        return LocatedGap(
            "x", Tap.MEAS, EffectStage.SENSOR, 1e-6, 3e-7, 10.0, (9.0, 11.0), portions, {}
        )

    assert make_gap(rows=0.021).worst_regime is OperatingRegime.REVERSAL
    assert make_gap(rows=0.019).worst_regime is OperatingRegime.FAST
