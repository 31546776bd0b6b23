"""Excursions of a reading are told from what the axis itself does."""

import numpy as np

from rotemina.sim.gap.noise.spikes import excursions

RATE_HZ = 1000.0


TIME_S = np.arange(8000) / RATE_HZ


NOISE = np.random.default_rng(0).standard_normal(len(TIME_S))


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
