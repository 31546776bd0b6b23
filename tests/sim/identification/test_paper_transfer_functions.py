"""The paper's transfer functions: their numbers, their two interpretations, bad files."""

import numpy as np
import pytest

from rotemina.sim.errors import IdentificationSettingError, ModelFileError
from rotemina.sim.identification import (
    interpret_model,
    load_published_models,
    to_transfer_function,
)
from rotemina.sim.identification.paper_transfer_functions import parse_models

MODELS = load_published_models().model
each_model = pytest.mark.parametrize(
    ("name", "equation", "pole", "zero", "gain"),
    [
        ("H_X", 2, 0.9997, -0.095, 0.0347),
        ("H_Y_th", 3, 0.9997, -0.081, 0.0332),
        ("H_Y_ex", 4, 0.9991, -0.128, 0.0353),
    ],
)


@each_model
def test_in_z_the_models_are_stable_and_a_pole_and_a_zero_nearly_cancel(
    name, equation, pole, zero, gain
):
    interpretation = interpret_model(MODELS[name], "z")
    assert MODELS[name].equation == equation
    np.testing.assert_allclose(interpretation.poles, [pole, 0.0, 0.0], atol=1e-12)
    np.testing.assert_allclose(interpretation.zeros, [1.0, zero], atol=5e-4)
    assert interpretation.stable
    assert (interpretation.integrators, interpretation.delay_samples) == (0, 1)
    assert interpretation.static_gain == 0.0
    ((cancelled, zero_nearby),) = interpretation.cancelling
    assert abs(cancelled - zero_nearby) < 1e-3
    assert interpretation.remaining_gain == pytest.approx(gain, abs=1e-4)
    assert interpretation.remaining_gain == pytest.approx(0.035, abs=0.002)


@each_model
def test_the_printed_digits_do_not_determine_the_static_gain(name, equation, pole, zero, gain):
    """The bound is half a digit of three coefficients over 1 − pole minus half a digit."""
    low, high = interpret_model(MODELS[name], "z").static_gain_bounds
    assert high == pytest.approx(1.5e-4 / (1.0 - pole - 0.5e-4))
    assert low == pytest.approx(-high)


@each_model
def test_in_s_the_models_are_unstable(name, equation, pole, zero, gain):
    interpretation = interpret_model(MODELS[name], "s")
    assert not interpretation.stable
    assert interpretation.integrators == 2
    assert interpretation.static_gain == np.inf
    assert interpretation.delay_samples is None
    assert interpretation.conclusions != interpret_model(MODELS[name], "z").conclusions


def test_the_discrete_interpretation_can_be_simulated():
    model = to_transfer_function(MODELS["H_X"], 150.0)
    response = model.simulate(np.ones(5))
    np.testing.assert_allclose(response[:2], [0.0, 0.0317])
    assert response[3] == pytest.approx(0.0347, abs=3e-5)
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
        load_published_models("nobody")
    with pytest.raises(IdentificationSettingError, match="choose 's' or 'z'"):
        interpret_model(MODELS["H_X"], "w")
