"""What commands do not cause is found, named and set aside; what they do cause is left alone."""

import numpy as np
import pytest

from rotemina.sim.gap.cells import beyond
from rotemina.sim.gap.coarseness import coarse_step, stands_on
from rotemina.sim.gap.disturbances import Disturbance, power_by_tap, set_aside
from rotemina.sim.gap.evidence import Evidence
from rotemina.sim.gap.excursions import excursions
from rotemina.sim.gap.jumps import jumps
from rotemina.sim.gap.models import mean_squares
from rotemina.sim.gap.tones import tones
from rotemina.sim.gap.wander import wander, wandering
from rotemina.sim.gap.whiteness import common_level, noise_level
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")
RATE_HZ = 1000.0
TIME_S = np.arange(8000) / RATE_HZ
NOISE = np.random.default_rng(0).standard_normal(len(TIME_S))


def steps_and_triangles(axis, share=0.1):
    """Move at constant speed, then in steps with holds between."""
    own = ROBOT.axes[axis]
    wave = 2.0 / np.pi * np.arcsin(np.sin(2.0 * np.pi * 0.5 * TIME_S))
    stairs = np.floor(TIME_S) % 3 - 1.0
    way = np.where(TIME_S < 4.0, wave, 0.3 * stairs)
    return Record.from_signals(
        TIME_S, {(axis, Tap.CMD): sum(own.range) / 2 + share * own.span * way}, {axis: own.unit}
    )


def aside(effects, axis, share=0.1, seeds=(0, 1)):
    command = steps_and_triangles(axis, share)
    records = [simulate(ROBOT, effects, command, np.random.default_rng(s)) for s in seeds]
    evidence = Evidence.of(ROBOT, axis, records)
    return evidence, *set_aside(evidence)


def rms(evidence):
    return float(np.sqrt(np.mean(evidence.residual() ** 2)))


@pytest.mark.parametrize("axis", ["zn", "thx"])
def test_a_healthy_axis_has_no_disturbances(axis):
    _, clean, found = aside([], axis)
    assert found == ()
    assert rms(clean) == pytest.approx(1.0, abs=0.05)


@pytest.mark.parametrize(
    "effect",
    [
        AxisEffect(axis="zn", id="sensor_noise"),
        AxisEffect(axis="zn", id="sensor_outliers"),
        AxisEffect(axis="zn", id="sensor_outliers", formulation="dropouts_to_zero"),
        AxisEffect(axis="zn", id="sensor_quantization", parameters={"step": 4e-7}),
        AxisEffect(axis="zn", id="vibration", parameters={"frequency": 37.3, "sine": 2e-7}),
    ],
    ids=lambda effect: f"{effect.id} {effect.formulation or ''}",
)
def test_a_disturbance_is_named_and_set_aside(effect):
    raw, clean, found = aside([effect], "zn")
    assert {one.effect for one in found if one.power > 0.03 * rms(raw) ** 2} == {effect.id}
    assert rms(raw) > 1.3
    assert rms(clean) < 1.3


@pytest.mark.parametrize(
    "effect", ["hysteresis", "delay", "creep", "gain_error", "resonance_mismatch", "contact"]
)
def test_what_commands_cause_is_no_disturbance(effect):
    raw, _, found = aside([AxisEffect(axis="zn", id=effect)], "zn")
    power = sum(one.power for one in found)
    assert power < 0.03 * rms(raw) ** 2


def test_lost_steps_are_taken_back_by_whole_multiples():
    lost = AxisEffect(
        axis="x", id="lost_steps", formulation="event", parameters={"time": 2.3, "slips": -2.0}
    )
    raw, clean, found = aside([lost], "x", share=0.01)
    assert {one.effect for one in found} == {"lost_steps"}
    assert rms(raw) > 100.0
    assert rms(clean) < 2.0


def test_lost_steps_that_a_screw_hides_are_seen_beside_its_error():
    lost = AxisEffect(
        axis="x", id="lost_steps", formulation="event", parameters={"time": 2.3, "slips": 1.0}
    )
    screw = AxisEffect(
        axis="x", id="leadscrew_error", parameters={"period": 1e-3, "sine": 6e-6, "cosine": 1.2e-5}
    )
    raw, _, hidden = aside([lost, screw], "x", share=0.05)
    assert hidden == ()
    clean, found = set_aside(raw, [screw])
    assert {one.effect for one in found} == {"lost_steps"}
    assert clean.robot is raw.robot
    # Behind the jump the screw stands elsewhere: some of its error is left.
    before, after = (np.mean(one.residual([screw]) ** 2) for one in (raw, clean))
    assert after < 0.5 * before


def test_noise_behind_a_late_sensor_is_measured_beside_its_lag():
    lag = AxisEffect(axis="zn", id="sensor_lag", parameters={"time_constant": 1e-3})
    noise = AxisEffect(axis="zn", id="sensor_noise", parameters={"rms": 3e-8})
    raw, _, _ = aside([lag, noise], "zn", share=0.4)
    _, found = set_aside(raw, [lag])
    (one,) = [each for each in found if each.effect == "sensor_noise"]
    declared = raw.floor(Tap.MEAS)
    assert one.power == pytest.approx((3e-8 / declared) ** 2, rel=0.25)


def test_a_wander_of_the_sensor_is_told_from_motion():
    drift = AxisEffect(axis="zn", id="sensor_drift", parameters={"rate": 5e-7})
    raw, clean, found = aside([drift], "zn")
    assert not {one.effect for one in found} - {"sensor_noise"}
    told = wander(clean, clean.residual())
    assert told is not None
    reading = mean_squares(raw, raw.residual())[Tap.MEAS]
    assert told.power == pytest.approx(reading, rel=0.2)
    assert wander(*(lambda e: (e, e.residual()))(aside([], "zn")[1])) is None


def test_a_record_too_noisy_to_prove_a_wander_counts_once_another_one_does():
    rng = np.random.default_rng(2)
    command = steps_and_triangles("zn")
    drifts = [
        AxisEffect(axis="zn", id="sensor_drift", parameters={"rate": rate}) for rate in (5e-8, 1e-8)
    ]
    records = [simulate(ROBOT, [one], command, rng) for one in drifts]
    evidence = Evidence.of(ROBOT, "zn", records)
    left = evidence.residual()
    loud, quiet = (left[part.rows] for part in evidence.parts if part.tap is Tap.MEAS)
    resting = np.zeros(len(TIME_S), dtype=bool)
    assert wandering(TIME_S, quiet, resting) is None
    told = wander(evidence, left)
    # Of two records alike in length, as far as they are not white.
    beyond = [np.mean(one**2) - np.mean(np.diff(one) ** 2) / 2.0 for one in (loud, quiet)]
    assert beyond[1] > 0.3
    assert told.power == pytest.approx(np.mean(beyond), rel=0.03)


def test_jumps_smaller_or_slower_than_lost_steps_are_left_alone():
    step = np.where(TIME_S > 3.0, 1.0, 0.0)
    assert [round(size) for _, size in jumps(TIME_S, 5.0 * step + 0.01 * NOISE, 5.0)] == [5]
    assert jumps(TIME_S, 2.0 * step + 0.01 * NOISE, 5.0) == []
    slow = np.clip((TIME_S - 3.0) / 0.5, 0.0, 1.0)
    assert jumps(TIME_S, 5.0 * slow + 0.01 * NOISE, 5.0) == []


def test_ringing_after_a_step_of_the_command_is_no_excursion():
    change = np.where(np.diff(TIME_S > 3.0, prepend=False), 1000.0, 0.0)
    moving = 5.0 * np.arange(len(TIME_S))
    since = np.maximum(TIME_S - 3.0, 0.0)
    ringing = 50.0 * np.exp(-since / 0.02) * np.sin(2 * np.pi * 300.0 * since) * (since > 0)
    assert not excursions(TIME_S, ringing + NOISE, moving, change).any()
    spiked = NOISE.copy()
    spiked[[500, 4000]] += 40.0
    found = excursions(TIME_S, spiked, moving + spiked, change)
    assert np.flatnonzero(found).tolist() == [500, 4000]


def test_in_lively_motion_a_lone_row_beside_a_reference_is_a_spike():
    lively = np.full(len(TIME_S), 30.0)  # a command that leaps at every row
    gap = NOISE.copy()
    gap[[500, 4000]] += 60.0
    reading = 5.0 * np.arange(len(TIME_S)) + gap
    assert not excursions(TIME_S, gap, reading, lively).any()  # the axis itself may ring
    found = excursions(TIME_S, gap, reading, lively, sure=True)
    assert np.flatnonzero(found).tolist() == [500, 4000]
    gap[2000:2006] += 60.0 * np.exp(-np.arange(6) / 2.0)  # a sensor that comes late
    found = excursions(TIME_S, gap, reading, lively, sure=True)
    assert np.flatnonzero(found).tolist() == [500, 4000]


def test_a_reading_that_stands_still_and_leaps_is_an_excursion_and_a_slip_is_none():
    moving = 5.0 * np.arange(len(TIME_S))
    behind = np.zeros(len(TIME_S))
    behind[1000:1009] = -5.0 * np.arange(1, 10)
    reading = moving + behind + 0.3 * NOISE
    found = excursions(TIME_S, behind + 0.3 * NOISE, reading, np.zeros(len(TIME_S)))
    assert set(range(1003, 1009)) <= set(np.flatnonzero(found)) <= set(range(999, 1010))
    slipping = behind.copy()
    slipping[1009:1018] = -45.0 + 5.0 * np.arange(1, 10)
    reading = moving + slipping + 0.3 * NOISE
    assert not excursions(TIME_S, slipping + 0.3 * NOISE, reading, np.zeros(len(TIME_S))).any()


def test_a_decaying_line_is_no_vibration():
    resting = np.zeros(len(TIME_S), dtype=bool)
    tone = 3.0 * np.sin(2 * np.pi * 23.0 * TIME_S)
    assert tones(TIME_S, tone + NOISE, resting) == pytest.approx([23.0], abs=0.05)
    assert tones(TIME_S, tone * np.exp(-TIME_S) + NOISE, resting) == []


def test_the_level_of_noise_is_found_below_lines_and_slow_motion():
    slow = 50.0 * np.sin(2 * np.pi * 0.4 * TIME_S) + 5.0 * np.sin(2 * np.pi * 60.0 * TIME_S)
    assert noise_level(2.5 * NOISE + slow) == pytest.approx(2.5, rel=0.12)
    assert noise_level(np.cumsum(NOISE)) == 0.0  # a wander


def test_a_coarse_grid_is_found_where_noise_does_not_fill_it():
    path = 1000.0 * np.sin(2 * np.pi * 0.2 * TIME_S)
    expected = np.rint(path + NOISE)
    assert coarse_step(8.0 * np.rint(path / 8.0), expected, 1.0) == pytest.approx(8.0, rel=0.01)
    assert coarse_step(np.rint(path + NOISE[::-1]), expected, 1.0) is None


def test_a_wander_must_go_on_at_rest():
    resting = TIME_S > 4.0
    walk = 0.3 * np.cumsum(NOISE)
    told = wandering(TIME_S, walk - walk.mean(), resting)
    assert told.at_rest is True
    assert wandering(TIME_S, _flicker() + NOISE, resting).at_rest is True
    moving = np.where(resting, 0.0, 5.0 * np.sin(2 * np.pi * 0.5 * TIME_S))
    assert wandering(TIME_S, moving, resting).at_rest is False
    relaxing = moving + 40.0 * np.exp(-TIME_S / 3.0)
    assert wandering(TIME_S, relaxing - relaxing.mean(), resting).at_rest is False
    never = np.zeros(len(TIME_S), dtype=bool)
    assert wandering(TIME_S, walk - walk.mean(), never).at_rest is None
    assert wandering(TIME_S, 30.0 * NOISE, resting) is None


def test_a_wander_that_no_rest_can_show_needs_a_reference():
    never = np.zeros(len(TIME_S), dtype=bool)
    walk = 0.3 * np.cumsum(NOISE)
    assert wandering(TIME_S, walk - walk.mean(), never).walks is True
    moving = 20.0 * np.sin(2 * np.pi * 0.5 * TIME_S)
    assert wandering(TIME_S, moving + NOISE, never).walks is False
    drift = AxisEffect(axis="zn", id="sensor_drift", parameters={"rate": 2e-6})
    command = steps_and_triangles("zn")
    moved = Record.from_signals(
        TIME_S[:4000], {("zn", Tap.CMD): command.signal("zn", Tap.CMD)[:4000]}, {"zn": "m"}
    )
    records = [simulate(ROBOT, [drift], moved, np.random.default_rng(seed)) for seed in (0, 1)]
    seen = Evidence.of(ROBOT, "zn", records)
    assert wander(seen, seen.residual()).effect == "sensor_drift"
    blind = [
        Record.from_signals(
            record.time_s,
            {("zn", tap): record.signal("zn", tap) for tap in (Tap.CMD, Tap.MEAS)},
            {"zn": "m"},
        )
        for record in records
    ]
    unseen = Evidence.of(ROBOT, "zn", blind)
    assert wander(unseen, unseen.residual()) is None


def test_what_shakes_the_axis_counts_at_its_sensor_in_floors_of_the_sensor():
    seen, _, _ = aside([], "zn")
    shaken = Disturbance("vibration", Tap.REF, 100.0, "")
    noisy = Disturbance("sensor_noise", Tap.MEAS, 5.0, "")
    share = (seen.floor(Tap.REF) / seen.floor(Tap.MEAS)) ** 2
    found = power_by_tap(seen, [shaken, noisy])
    assert found == {Tap.REF: 100.0, Tap.MEAS: pytest.approx(5.0 + 100.0 * share)}


def _read_in_steps(*effects):
    coarse = AxisEffect(axis="zn", id="sensor_quantization", parameters={"step": 5e-7})
    wave = 2.0 / np.pi * np.arcsin(np.sin(2.0 * np.pi * 0.25 * TIME_S))
    command = Record.from_signals(
        TIME_S, {("zn", Tap.CMD): (32.5 + 6.5 * wave) * 1e-6}, {"zn": "m"}
    )
    record = simulate(ROBOT, [coarse, *effects], command, np.random.default_rng(0))
    seen, found = set_aside(Evidence.of(ROBOT, "zn", [record]))
    assert "sensor_quantization" in {one.effect for one in found}
    assert seen.observations[0].cell[Tap.MEAS] == pytest.approx(5e-7, rel=0.01)
    return seen


def test_what_lies_within_the_steps_of_a_coarse_reading_is_no_gap():
    even = _read_in_steps()
    assert 0.1 < mean_squares(even, even.residual())[Tap.MEAS] < 1.3


def test_what_lies_beyond_the_steps_of_a_coarse_reading_is_a_gap():
    bent = AxisEffect(axis="zn", id="gain_error", parameters={"error": 0.01})
    seen = _read_in_steps(bent)
    # The triangle of 6.5 µm reaches 65 nm beyond an edge, in that share of the rows of a step:
    # ∫ d³ / (3 step) over its even spread, to 1 % of 6.5 µm, is d³ / (12 step).
    expected = 6.5e-8**3 / (12.0 * 5e-7)
    left = mean_squares(seen, seen.residual())[Tap.MEAS] * seen.floor(Tap.MEAS) ** 2
    assert left == pytest.approx(expected, rel=0.35)
    assert mean_squares(seen, seen.residual([bent]))[Tap.MEAS] < 1.3


def test_a_gap_beyond_cells_is_found_whatever_the_offset():
    gap = np.linspace(-3.0, 5.0, 4001)
    left = beyond(gap, 1.0, None)
    # What leaves least is as far beyond on either side: the middle is taken off.
    assert left.min() == pytest.approx(-3.0, abs=0.01)
    assert left.max() == pytest.approx(3.0, abs=0.01)
    assert np.abs(beyond(0.9 * np.sin(TIME_S) + 70.0, 1.0, None)).max() < 1e-3
    kept = np.ones(len(gap), dtype=bool)
    kept[-500:] = False
    some = beyond(gap, 1.0, kept)
    assert not some[~kept].any()
    assert some[kept].max() == pytest.approx(-some[kept].min(), abs=0.01)


def test_a_sensor_that_is_noisy_in_one_record_alone_is_not():
    assert common_level([1.0, 3.6, 0.9]) == 1.0
    assert common_level([0.0, 2.0, 2.1]) == 2.0  # a wander tells nothing of noise
    assert common_level([0.0]) == 0.0


def test_steps_of_a_drive_are_none_of_the_sensor():
    path = 1000.0 * np.sin(2 * np.pi * 0.2 * TIME_S)
    quick = 30000.0 * np.sin(2 * np.pi * 3.0 * TIME_S)
    assert stands_on(8.0 * np.rint(quick / 8.0), np.rint(quick + NOISE), 1.0, 8.0)
    moved = 8.0 * np.rint(path / 8.0)
    lagging = np.convolve(moved, np.ones(40) / 40.0, mode="same")  # it rests on them for a while
    assert not stands_on(np.rint(lagging), np.rint(path + NOISE), 1.0, 8.0)


def test_spikes_at_rest_prove_those_in_lively_motion():
    lively = Record.from_signals(
        TIME_S,
        {("zn", Tap.CMD): (32.5 + 8.0 * np.sign(np.sin(2 * np.pi * 40.0 * TIME_S))) * 1e-6},
        {"zn": "m"},
    )
    held = np.full(len(TIME_S), 32.5e-6)
    calm = Record.from_signals(TIME_S, {("zn", Tap.CMD): held}, {"zn": "m"})
    rng = np.random.default_rng(0)

    def spiked(record, rows):
        seen = simulate(ROBOT, [], record, rng)
        reading = seen.signal("zn", Tap.MEAS).copy()
        reading[rows] += 4e-6
        signals = {("zn", Tap.CMD): seen.signal("zn", Tap.CMD), ("zn", Tap.MEAS): reading}
        return Record.from_signals(seen.time_s, signals, {"zn": "m"}, dict(seen.metadata))

    rows = np.arange(200, 5800, 700)
    alone, _ = set_aside(Evidence.of(ROBOT, "zn", [spiked(lively, rows)]))
    both, _ = set_aside(Evidence.of(ROBOT, "zn", [spiked(lively, rows), spiked(calm, rows)]))
    assert Tap.MEAS not in alone.observations[0].kept or alone.observations[0].kept[Tap.MEAS].all()
    assert not both.observations[0].kept[Tap.MEAS][rows].any()


def _flicker():
    tones = np.fft.rfft(np.random.default_rng(3).standard_normal(len(TIME_S)))
    tones[1:] /= np.sqrt(np.arange(1, len(tones)))
    tones[0] = 0.0
    flicker = np.fft.irfft(tones, len(TIME_S))
    return 30.0 * flicker / flicker.std()
