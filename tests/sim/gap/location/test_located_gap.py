"""Where the gap lies: taps, stages, bands and regimes of known causes."""

import numpy as np
import pytest

from rotemina.sim.effects.formulation import Stage
from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.gap.location.located_gap import LocatedGap, Portion, locate
from rotemina.sim.gap.location.regimes import Regime
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
    assert found.by_regime[Regime.REST].excess < 1.0 < found.by_regime[Regime.FAST].excess


def test_a_loop_shows_on_large_swings_more_than_on_small_ones():
    def swings(size):
        time_s = np.arange(6000) / 1000.0
        wave = 2.0 / np.pi * np.arcsin(np.sin(2.0 * np.pi * time_s))
        return size * np.where(time_s < 3.0, 1.0, 0.2) * wave

    own = ROBOT.axes["zn"]
    command = sum(own.range) / 2 + swings(0.3 * own.span)
    record = Record.from_signals(np.arange(6000) / 1000.0, {("zn", Tap.CMD): command}, {"zn": "m"})
    loop = AxisEffect(axis="zn", id="hysteresis", parameters={"shape": 1.5})
    seen = simulate(ROBOT, [loop], record, np.random.default_rng(0))
    (found,) = (
        one
        for one in locate(Evidence.of(ROBOT, "zn", [seen]), np.random.default_rng(1))
        if one.tap is Tap.MEAS
    )
    large, small = found.by_regime[Regime.LARGE_SWING], found.by_regime[Regime.SMALL_SWING]
    assert large.excess > 4.0 * small.excess
    assert large.share + small.share == pytest.approx(1.0, abs=0.01)
    low, high = large.share_interval
    assert low <= large.share <= high
    assert sum(one.share for one in found.by_band.values()) == pytest.approx(1.0, abs=0.02)


def test_uneven_samples_tell_no_band():
    rng = np.random.default_rng(3)
    time_s = np.cumsum(rng.uniform(0.5, 1.5, 500)) * 1e-3
    command = 3e-5 + 1e-5 * np.sin(20.0 * time_s)
    reading = 1.1 * command + 1e-9 * rng.standard_normal(500)
    signals = {("zn", Tap.CMD): command, ("zn", Tap.MEAS): reading}
    record = Record.from_signals(time_s, signals, {"zn": "m"})
    (found,) = locate(Evidence.of(ROBOT, "zn", [record]), rng)
    assert found.significant
    assert found.by_band == {}
    assert found.worst_band_hz is None


def test_a_single_moment_is_sudden_though_other_moments_might_lack_it():
    rng = np.random.default_rng(4)
    time_s = np.arange(6000) / 1000.0
    command = np.where(time_s < 2.0, 3e-5, 3.2e-5)
    floor = ROBOT.axes["zn"].sensor.noise_floor
    asked = Record.from_signals(time_s, {("zn", Tap.CMD): command}, {"zn": "m"})
    calm = simulate(ROBOT, [], asked, rng).signal("zn", Tap.MEAS)
    rung = calm + 200.0 * floor * ((time_s > 2.0) & (time_s < 2.1)) * np.sin(900.0 * time_s)
    for reading, sudden in ((calm, False), (rung, True)):
        signals = {("zn", Tap.CMD): command, ("zn", Tap.MEAS): reading}
        record = Record.from_signals(time_s, signals, {"zn": "m"})
        (found,) = locate(Evidence.of(ROBOT, "zn", [record]), rng)
        assert not found.significant
        assert found.sudden is sudden


def test_what_an_axis_hardly_did_is_not_named_as_the_worst():
    def place(rows):
        """A gap of 10 floors² over all, three times as large in so small a share of the rows."""
        portions = {
            Regime.FAST: Portion(0.9, (0.8, 1.0), 9.0),
            Regime.REVERSAL: Portion(3.0 * rows, (0.0, 1.0), 30.0),
        }
        return LocatedGap("x", Tap.MEAS, Stage.SENSOR, 1e-6, 3e-7, 10.0, (9.0, 11.0), portions, {})

    assert place(rows=0.021).worst_regime is Regime.REVERSAL
    assert place(rows=0.019).worst_regime is Regime.FAST
