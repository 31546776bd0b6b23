"""Spikes of a reading are distinguished from motion of the axis."""

import numpy as np

from rotemina.sim.gap.noise.spikes import excursions

RATE_HZ = 1000.0
TIME_S = np.arange(8000) / RATE_HZ
NOISE = np.random.default_rng(0).standard_normal(len(TIME_S))


def test_oscillation_after_a_step_of_the_command_is_not_an_excursion():
    change = np.where(np.diff(TIME_S > 3.0, prepend=False), 1000.0, 0.0)
    moving = 5.0 * np.arange(len(TIME_S))
    time_after_step_s = np.maximum(TIME_S - 3.0, 0.0)
    ringing = (
        50.0
        * np.exp(-time_after_step_s / 0.02)
        * np.sin(2 * np.pi * 300.0 * time_after_step_s)
        * (time_after_step_s > 0)
    )
    assert not excursions(TIME_S, ringing + NOISE, moving, change).any()
    with_spikes = NOISE.copy()
    with_spikes[[500, 4000]] += 40.0
    is_excursion = excursions(TIME_S, with_spikes, moving + with_spikes, change)
    assert np.flatnonzero(is_excursion).tolist() == [500, 4000]


def test_in_fast_motion_a_single_row_is_a_spike_if_there_is_a_reference():
    # The command jumps at every row.
    fast_command = np.full(len(TIME_S), 30.0)
    gap = NOISE.copy()
    gap[[500, 4000]] += 60.0
    reading = 5.0 * np.arange(len(TIME_S)) + gap
    # The axis itself may oscillate.
    assert not excursions(TIME_S, gap, reading, fast_command).any()
    is_excursion = excursions(TIME_S, gap, reading, fast_command, sure=True)
    assert np.flatnonzero(is_excursion).tolist() == [500, 4000]
    # A delayed sensor.
    gap[2000:2006] += 60.0 * np.exp(-np.arange(6) / 2.0)
    is_excursion = excursions(TIME_S, gap, reading, fast_command, sure=True)
    assert np.flatnonzero(is_excursion).tolist() == [500, 4000]


def test_a_reading_that_stops_and_jumps_is_an_excursion_and_a_slip_is_not():
    moving = 5.0 * np.arange(len(TIME_S))
    lag = np.zeros(len(TIME_S))
    lag[1000:1009] = -5.0 * np.arange(1, 10)
    reading = moving + lag + 0.3 * NOISE
    is_excursion = excursions(TIME_S, lag + 0.3 * NOISE, reading, np.zeros(len(TIME_S)))
    assert set(range(1003, 1009)) <= set(np.flatnonzero(is_excursion)) <= set(range(999, 1010))
    slipping = lag.copy()
    slipping[1009:1018] = -45.0 + 5.0 * np.arange(1, 10)
    reading = moving + slipping + 0.3 * NOISE
    assert not excursions(TIME_S, slipping + 0.3 * NOISE, reading, np.zeros(len(TIME_S))).any()
