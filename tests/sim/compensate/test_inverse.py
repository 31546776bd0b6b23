"""The inverse at run time: equal results by sample and as an array, and its exceedances."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.compensate import Inverse, InverseExceedance
from rotemina.sim.compensate.inverse_parameters import RulePremises
from rotemina.sim.errors import CompensationError

SAMPLE_S = 1e-3


@pytest.fixture(scope="module")
def model(make_inverse_model):
    """Model with every stage: rules over position and a stop, plays, a bend, creep and a lag."""
    rng = np.random.default_rng(0)
    plays = 6
    centres = np.tile(np.linspace(0.0, 1.0, 3), (2, 1))
    consequents = rng.normal(0.0, 0.03, (9, 2 + plays))
    consequents[:, 1] += 1.0
    return make_inverse_model(
        kind="anfis",
        speed=5e-3,
        consequents=consequents,
        radii=np.linspace(0.02, 0.4, plays),
        initial=np.linspace(0.01, 0.1, plays),
        premises=RulePremises((-1, 2), centres, np.full((2, 3), 0.3)),
        lag_s=7e-4,
        mode_s2=1.4e-7,
        creep_times_s=np.array([0.1, 1.0]),
        creep_weights=np.array([0.01, 0.02]),
        bend_offset=0.01,
        bend_at=np.array([0.3, 0.6]),
        bend=np.array([1.0, -0.1, 0.2]),
    )


def make_motion(rows=3000):
    turn = np.linspace(0.0, 40.0, rows)
    return 31e-6 + 25e-6 * np.sin(turn) * np.cos(0.21 * turn)


@pytest.fixture
def make_linear_model(make_inverse_model):
    """Return a function that returns the simplest model, with changed fields."""
    simplest = {
        "axis": "p",
        "kind": "linear",
        "span": 1e-5,
        "desired_range": (0.0, 1e-5),
        "command_range": (0.0, 1e-5),
        "consequents": np.array([[0.0, 1.0]]),
        "radii": np.zeros(0),
        "initial": np.zeros(0),
    }
    return lambda **changes: make_inverse_model(**(simplest | changes))


@pytest.mark.parametrize("preview", [False, True])
def test_commands_by_sample_equal_those_of_an_array(model, preview):
    desired = make_motion()
    inverse = Inverse(model, SAMPLE_S, preview=preview)
    commands = inverse.run(desired)
    inverse.reset()
    assert [inverse.step(position) for position in desired] == commands.tolist()
    assert np.ptp(commands) > 1e-5


def test_a_copied_state_continues_at_the_same_point(model):
    desired = make_motion()
    whole = Inverse(model, SAMPLE_S).run(desired)
    first, second = Inverse(model, SAMPLE_S), Inverse(model, SAMPLE_S)
    first.run(desired[:1000])
    second.state = first.state
    assert second.run(desired[1000:]).tolist() == whole[1000:].tolist()
    assert first.reset().run(desired).tolist() == whole.tolist()


def test_an_inverse_begins_at_rest(model):
    settled = Inverse(replace(model, bend=np.array([1.0, 0.0, 0.0])), SAMPLE_S)
    commands = settled.run(np.full(2000, 30e-6))
    assert commands == pytest.approx(commands[0], rel=1e-12)


def test_positions_out_of_range_are_clamped_and_reported(make_linear_model):
    inverse = Inverse(make_linear_model(), SAMPLE_S)
    assert inverse.step(5e-6) == pytest.approx(5e-6)
    assert inverse.exceedance == InverseExceedance(0)
    assert inverse.step(1.2e-5) == pytest.approx(1e-5)
    assert inverse.exceedance == InverseExceedance.HIGH
    assert inverse.step(-1e-6) == 0.0
    assert inverse.exceedance == InverseExceedance.LOW
    limited = Inverse(make_linear_model(speed=1e-3), SAMPLE_S)
    commands, exceedances = limited.run_with_exceedances(np.array([0.0, 5e-7, 5e-6]))
    assert exceedances.tolist() == [0, 0, InverseExceedance.FAST]
    assert commands[-1] == pytest.approx(5e-6)
    assert limited.exceedance == InverseExceedance.FAST


def test_a_command_stays_within_the_limits_of_the_machine(make_linear_model):
    inverse = Inverse(make_linear_model(consequents=np.array([[0.0, 2.0]])), SAMPLE_S)
    assert inverse.step(8e-6) == 1e-5
    assert inverse.exceedance == InverseExceedance.COMMAND


def test_positions_out_of_range_are_refused_with_row_and_value(make_linear_model):
    inverse = Inverse(make_linear_model(), SAMPLE_S)
    inverse.check_range(np.array([0.0, 1e-5]))
    with pytest.raises(CompensationError, match="axis p: desired position 20 µm at sample 1 lies"):
        inverse.check_range(np.array([0.0, 2e-5]))
    with pytest.raises(CompensationError, match="at sample 0"):
        inverse.check_range(np.array([np.nan]))


def test_a_position_that_is_no_number_is_refused_and_leaves_the_state(make_linear_model):
    inverse = Inverse(make_linear_model(), SAMPLE_S)
    inverse.step(3e-6)
    before = inverse.state
    assert np.isnan(inverse.step(np.nan))
    assert inverse.state.tolist() == before.tolist()
    with pytest.raises(CompensationError, match="one column of finite numbers"):
        inverse.run(np.array([1e-6, np.inf]))
    with pytest.raises(CompensationError, match="state of shape"):
        inverse.state = np.zeros(1)


@pytest.mark.parametrize("sample_s", [0.0, -1.0, np.nan, np.inf])
def test_a_sampling_time_that_makes_no_sense_is_refused(sample_s, make_linear_model):
    with pytest.raises(CompensationError, match="sample_s = "):
        Inverse(make_linear_model(), sample_s)


@pytest.mark.parametrize("sample_s", [1e-3, 5e-4])
def test_a_lag_is_compensated_at_any_rate(sample_s, make_linear_model):
    """The axis lags by 2 ms, and a command held for a sample lags by half of it."""
    lag_s = 2e-3 + 0.5 * SAMPLE_S
    time_s = np.arange(0.0, 1.0, sample_s)
    desired = 5e-6 + 3e-6 * np.sin(2.0 * np.pi * 3.0 * time_s)
    commands = Inverse(make_linear_model(lag_s=lag_s), sample_s).run(desired)
    ahead_s = time_s + 2e-3 + 0.5 * sample_s
    ahead = 5e-6 + 3e-6 * np.sin(2.0 * np.pi * 3.0 * ahead_s)
    assert np.abs(commands - ahead)[3:].max() < 2e-3 * 3e-6
    assert Inverse(make_linear_model(lag_s=lag_s), sample_s, preview=True).run(
        desired
    ) == pytest.approx(desired)


def test_creep_is_compensated(make_linear_model):
    """``y = x + w (z − x₀)``, ``τ ż = x − z``: its inverse relaxes faster by ``1 + w``."""
    weight, tau_s = 0.1, 0.5
    model = make_linear_model(
        creep_times_s=np.array([tau_s / (1.0 + weight)]),
        creep_weights=np.array([weight / (1.0 + weight)]),
    )
    commands = Inverse(model, SAMPLE_S).run(np.concatenate([[2e-6], np.full(1000, 6e-6)]))
    relaxed, positions = commands[0], []
    for command in commands:
        positions.append(command + weight * (relaxed - commands[0]))
        relaxed += -np.expm1(-SAMPLE_S / tau_s) * (command - relaxed)
    assert positions[5:] == pytest.approx(np.full(996, 6e-6), rel=2e-4)
