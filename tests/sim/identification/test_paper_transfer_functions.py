"""The paper's transfer functions: their numbers, both readings, bad files."""

import numpy as np
import pytest

from rotemina.sim.identification.errors import ModelFileError, SettingError
from rotemina.sim.identification.paper_transfer_functions import (
    as_discrete,
    parse_models,
    published_models,
    reading,
)

MODELS = published_models().model
EACH = pytest.mark.parametrize(
    ("name", "equation", "pole", "zero", "gain"),
    [
        ("H_X", 2, 0.9997, -0.095, 0.0347),
        ("H_Y_th", 3, 0.9997, -0.081, 0.0332),
        ("H_Y_ex", 4, 0.9991, -0.128, 0.0353),
    ],
)


@EACH
def test_read_in_z_they_are_stable_and_a_pair_all_but_cancels(name, equation, pole, zero, gain):
    read = reading(MODELS[name], "z")
    assert MODELS[name].equation == equation
    np.testing.assert_allclose(read.poles, [pole, 0.0, 0.0], atol=1e-12)
    np.testing.assert_allclose(read.zeros, [1.0, zero], atol=5e-4)
    assert read.stable
    assert (read.integrators, read.delay_samples) == (0, 1)
    assert read.static_gain == 0.0
    ((cancelled, by),) = read.cancelling
    assert abs(cancelled - by) < 1e-3
    assert read.remaining_gain == pytest.approx(gain, abs=1e-4)
    assert read.remaining_gain == pytest.approx(0.035, abs=0.002)


@EACH
def test_the_printed_digits_leave_the_static_gain_open(name, equation, pole, zero, gain):
    """Three coefficients of half a digit each, over 1 − pole and its own half digit."""
    low, high = reading(MODELS[name], "z").static_gain_bounds
    assert high == pytest.approx(1.5e-4 / (1.0 - pole - 0.5e-4))
    assert low == pytest.approx(-high)


@EACH
def test_read_in_s_they_are_unstable(name, equation, pole, zero, gain):
    read = reading(MODELS[name], "s")
    assert not read.stable
    assert read.integrators == 2
    assert read.static_gain == np.inf
    assert read.delay_samples is None
    assert read.conclusions != reading(MODELS[name], "z").conclusions


def test_the_discrete_reading_can_be_simulated():
    model = as_discrete(MODELS["H_X"], 150.0)
    answer = model.simulate(np.ones(5))
    np.testing.assert_allclose(answer[:2], [0.0, 0.0317])
    assert answer[3] == pytest.approx(0.0347, abs=3e-5)
    assert model.rate_hz == 150.0


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (("equation = 2", 'equation = "two"'), "bad.toml: model.H.equation"),
        (("axis = ", "axle = "), "axle"),
        (("numerator = [1.0]", "numerator = [1.0, 2.0, 3.0]"), r"model\.H: 3 coefficients"),
        (("[source]", "[source"), "not valid TOML"),
    ],
)
def test_bad_files_are_refused_with_file_and_key(change, message):
    text = (
        '[source]\ntitle = "t"\nprinted_variable = "s"\nlast_digit = 1e-4\n'
        'resampling_factor = 0.15\n[model.H]\nequation = 2\naxis = "x"\n'
        "numerator = [1.0]\ndenominator = [1.0, 0.5]\n"
    )
    assert parse_models(text).model["H"].axis == "x"
    with pytest.raises(ModelFileError, match=message):
        parse_models(text.replace(*change), "bad.toml")


def test_unknown_names_are_refused():
    with pytest.raises(ModelFileError, match="choose from rotemina"):
        published_models("nobody")
    with pytest.raises(SettingError, match="choose 's' or 'z'"):
        reading(MODELS["H_X"], "w")
