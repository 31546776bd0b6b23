"""The contract of an inverse at work: the same numbers by sample and in a row, and what is said."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.compensate.errors import CompensationError
from rotemina.sim.compensate.inverse import Exceedance, Inverse
from rotemina.sim.compensate.inverse_parameters import InverseModel, Premises

SAMPLE_S = 1e-3


@pytest.fixture(scope="module")
def model():
    """Rules over position and a stop, plays, a bend, creep and a lag: every stage there is."""
    rng = np.random.default_rng(0)
    plays = 6
    centres = np.tile(np.linspace(0.0, 1.0, 3), (2, 1))
    consequents = rng.normal(0.0, 0.03, (9, 2 + plays))
    consequents[:, 1] += 1.0
    return InverseModel(
        axis="zn",
        unit="m",
        kind="anfis",
        sample_s=SAMPLE_S,
        origin=0.0,
        command_origin=0.0,
        span=65e-6,
        desired_range=(2e-6, 60e-6),
        command_range=(0.0, 65e-6),
        speed=5e-3,
        consequents=consequents,
        radii=np.linspace(0.02, 0.4, plays),
        initial=np.linspace(0.01, 0.1, plays),
        premises=Premises((-1, 2), centres, np.full((2, 3), 0.3)),
        lag_s=7e-4,
        mode_s2=1.4e-7,
        creep_times_s=np.array([0.1, 1.0]),
        creep_weights=np.array([0.01, 0.02]),
        bend_offset=0.01,
        bend_at=np.array([0.3, 0.6]),
        bend=np.array([1.0, -0.1, 0.2]),
    )


def motion(rows=3000):
    turn = np.linspace(0.0, 40.0, rows)
    return 31e-6 + 25e-6 * np.sin(turn) * np.cos(0.21 * turn)


def line(**changes):
    """Return the plainest model: twice the position, and what is changed."""
    plain = InverseModel(
        axis="p",
        unit="m",
        kind="linear",
        sample_s=SAMPLE_S,
        origin=0.0,
        command_origin=0.0,
        span=1e-5,
        desired_range=(0.0, 1e-5),
        command_range=(0.0, 1e-5),
        speed=1.0,
        consequents=np.array([[0.0, 1.0]]),
    )
    return replace(plain, **changes)


@pytest.mark.parametrize("preview", [False, True])
def test_by_sample_and_in_a_row_are_the_same_numbers(model, preview):
    wanted = motion()
    inverse = Inverse(model, SAMPLE_S, preview=preview)
    row = inverse.run(wanted)
    inverse.reset()
    assert [inverse.step(value) for value in wanted] == row.tolist()
    assert np.ptp(row) > 1e-5


def test_a_state_goes_on_where_it_was_taken(model):
    wanted = motion()
    whole = Inverse(model, SAMPLE_S).run(wanted)
    first, second = Inverse(model, SAMPLE_S), Inverse(model, SAMPLE_S)
    first.run(wanted[:1000])
    second.state = first.state
    assert second.run(wanted[1000:]).tolist() == whole[1000:].tolist()
    assert first.reset().run(wanted).tolist() == whole.tolist()


def test_it_begins_at_rest(model):
    settled = Inverse(replace(model, bend=np.array([1.0, 0.0, 0.0])), SAMPLE_S)
    commands = settled.run(np.full(2000, 30e-6))
    assert commands == pytest.approx(commands[0], rel=1e-12)


def test_what_lies_beyond_is_clamped_and_said():
    inverse = Inverse(line(), SAMPLE_S)
    assert inverse.step(5e-6) == pytest.approx(5e-6)
    assert inverse.beyond == Exceedance(0)
    assert inverse.step(1.2e-5) == pytest.approx(1e-5)
    assert inverse.beyond == Exceedance.HIGH
    assert inverse.step(-1e-6) == 0.0
    assert inverse.beyond == Exceedance.LOW
    quick = Inverse(line(speed=1e-3), SAMPLE_S)
    commands, said = quick.run_and_tell(np.array([0.0, 5e-7, 5e-6]))
    assert said.tolist() == [0, 0, Exceedance.FAST]
    assert commands[-1] == pytest.approx(5e-6)
    assert quick.beyond == Exceedance.FAST


def test_a_command_stays_inside_the_machine():
    inverse = Inverse(line(consequents=np.array([[0.0, 2.0]])), SAMPLE_S)
    assert inverse.step(8e-6) == 1e-5
    assert inverse.beyond == Exceedance.COMMAND


def test_positions_beyond_are_refused_with_row_value_and_bound():
    inverse = Inverse(line(), SAMPLE_S)
    inverse.check(np.array([0.0, 1e-5]))
    with pytest.raises(CompensationError, match="axis p: desired position 20 µm at sample 1 lies"):
        inverse.check(np.array([0.0, 2e-5]))
    with pytest.raises(CompensationError, match="at sample 0"):
        inverse.check(np.array([np.nan]))


def test_what_is_no_number_is_refused_and_not_remembered():
    inverse = Inverse(line(), SAMPLE_S)
    inverse.step(3e-6)
    before = inverse.state
    assert np.isnan(inverse.step(np.nan))
    assert inverse.state.tolist() == before.tolist()
    with pytest.raises(CompensationError, match="one column of finite numbers"):
        inverse.run(np.array([1e-6, np.inf]))
    with pytest.raises(CompensationError, match="state of shape"):
        inverse.state = np.zeros(1)


@pytest.mark.parametrize("sample_s", [0.0, -1.0, np.nan, np.inf])
def test_a_sampling_time_that_makes_no_sense_is_refused(sample_s):
    with pytest.raises(CompensationError, match="sample_s = "):
        Inverse(line(), sample_s)


@pytest.mark.parametrize("sample_s", [1e-3, 5e-4])
def test_a_lag_is_made_up_for_at_any_rate(sample_s):
    """Of an axis late by 2 ms, and of a command held for a sample, which is late by half of it."""
    lag_s = 2e-3 + 0.5 * SAMPLE_S
    time_s = np.arange(0.0, 1.0, sample_s)
    wanted = 5e-6 + 3e-6 * np.sin(2.0 * np.pi * 3.0 * time_s)
    sent = Inverse(line(lag_s=lag_s), sample_s).run(wanted)
    ahead_s = time_s + 2e-3 + 0.5 * sample_s
    ahead = 5e-6 + 3e-6 * np.sin(2.0 * np.pi * 3.0 * ahead_s)
    assert np.abs(sent - ahead)[3:].max() < 2e-3 * 3e-6
    assert Inverse(line(lag_s=lag_s), sample_s, preview=True).run(wanted) == pytest.approx(wanted)


def test_creep_is_taken_off():
    """``y = x + w (z − x₀)``, ``τ ż = x − z``: its inverse relaxes faster by ``1 + w``."""
    weight, tau_s = 0.1, 0.5
    model = line(
        creep_times_s=np.array([tau_s / (1.0 + weight)]),
        creep_weights=np.array([weight / (1.0 + weight)]),
    )
    sent = Inverse(model, SAMPLE_S).run(np.concatenate([[2e-6], np.full(1000, 6e-6)]))
    lag, answer = sent[0], []
    for command in sent:
        answer.append(command + weight * (lag - sent[0]))
        lag += -np.expm1(-SAMPLE_S / tau_s) * (command - lag)
    assert answer[5:] == pytest.approx(np.full(996, 6e-6), rel=2e-4)
