"""The paper's transfer functions, Eqs. (2)-(4), interpreted in s and in z."""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass as plain_dataclass
from importlib import resources
from typing import Literal

import numpy as np
from pydantic import TypeAdapter, ValidationError
from pydantic.dataclasses import dataclass

from rotemina.sim.arrays import ComplexArray, FloatArray
from rotemina.sim.errors import IdentificationSettingError, ModelFileError, describe_exception
from rotemina.sim.identification.transfer_function import TransferFunction
from rotemina.sim.robot import (
    FORBID_UNKNOWN,
    Count,
    Number,
    Positive,
)
from rotemina.sim.robot_files import describe_error

SHIPPED_MODELS_PACKAGE = "rotemina.resources.models"
# Largest distance between a pole and a zero that nearly cancel.
_CANCELLATION_DISTANCE = 0.01
# Largest distance of an integrator's pole from 0 in s, or from 1 in z.
_MAX_INTEGRATOR_DISTANCE = 1e-9

CONCLUSIONS_IN_S = (
    "Unstable: a pole at +1 rad/s and a double integrator. A constant input would drive the "
    "table away without bound, while the real one stays where it is sent.",
    "It cannot be simulated over a run, and no gain, bandwidth or damping follows from it.",
    "It shows only that 's' is not the variable in which it was identified.",
)
CONCLUSIONS_IN_Z = (
    "Stable: a discrete identification of sampled data, one sample of delay. The rate is not "
    "printed, so times are known in samples alone.",
    "The zero at 1 all but cancels the slow pole; what is left answers within two samples with "
    "the remaining gain a sample. The figures show no slower dynamics, and no resonance.",
    "The static gain is zero as printed, but the last digits leave even its sign open: see its "
    "bounds. Only the gain without the cancelled pair is well determined.",
)


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class PrintedModel:
    """A ratio of polynomials as printed, with coefficients in order of falling powers."""

    equation: Count
    axis: str
    numerator: tuple[Number, ...]
    denominator: tuple[Number, ...]


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class _ModelSource:
    title: str
    printed_variable: str
    last_digit: Positive
    resampling_factor: Positive


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class PublishedModels:
    """A file of published models: their source, and each model by name."""

    source: _ModelSource
    model: Mapping[str, PrintedModel]


@plain_dataclass(frozen=True, slots=True, eq=False)
class ModelInterpretation:
    """Properties of a printed model for one interpretation of its variable.

    Attributes
    ----------
    variable : "s" or "z"
        "s" is continuous, rad/s; "z" is discrete, per sample.
    poles, zeros : complex
        Sorted by magnitude, largest first.
    stable : bool
        Whether all poles lie left of the imaginary axis, or inside the unit circle.
    integrators : int
        Number of poles at s = 0, or at z = 1.
    delay_samples : int or None
        Delay in z, the excess of poles over zeros; None in s.
    static_gain : float
        Gain at s = 0, or at z = 1; infinite (without a sign) with an integrator.
    static_gain_bounds : (float, float)
        Lowest and highest value that is compatible with the rounding of the printed digits.
    cancelling : tuple of (pole, zero)
        Pairs closer than 0.01.
    remaining_gain : float
        Static gain without those pairs; infinite with an integrator.
    conclusions : tuple of str
        Which conclusions the interpretation allows, and which it does not.
    """

    variable: Literal["s", "z"]
    poles: ComplexArray
    zeros: ComplexArray
    stable: bool
    integrators: int
    delay_samples: int | None
    static_gain: float
    static_gain_bounds: tuple[float, float]
    cancelling: tuple[tuple[complex, complex], ...]
    remaining_gain: float
    conclusions: tuple[str, ...]


def load_published_models(name: str = "rotemina") -> PublishedModels:
    """Load a shipped file of models.

    Raises
    ------
    ModelFileError
        If there is no file of that name, or it is not valid.
    """
    names = sorted(
        item.name[:-5]
        for item in resources.files(SHIPPED_MODELS_PACKAGE).iterdir()
        if item.name.endswith(".toml")
    )
    if name not in names:
        raise ModelFileError(
            "{name}: there are no shipped models of this name; choose from {names}",
            name=name,
            names=", ".join(names),
        )
    text = resources.files(SHIPPED_MODELS_PACKAGE).joinpath(f"{name}.toml").read_text("utf-8")
    return parse_models(text, f"{name}.toml")


def parse_models(text: str, source: str = "model file") -> PublishedModels:
    """Read models from TOML.

    Parameters
    ----------
    text : str
    source : str
        Name of the file in error messages.

    Raises
    ------
    ModelFileError
        If the text is not valid. The message names file, key, value and bound.
    """
    try:
        models = TypeAdapter(PublishedModels).validate_python(tomllib.loads(text))
    except tomllib.TOMLDecodeError as error:
        raise ModelFileError(
            "{source}: not valid TOML: {error}", source=source, error=describe_exception(error)
        ) from error
    except ValidationError as error:
        raise ModelFileError(
            "{source}: {describe}", source=source, describe=describe_error(error)
        ) from error
    for name, model in models.model.items():
        is_improper = not model.numerator or len(model.numerator) > len(model.denominator)
        if is_improper or model.denominator[0] != 1.0:
            raise ModelFileError(
                "{source}: model.{name}: {count} coefficients over {denominator}; the "
                "denominator must begin with 1 and be at least as long",
                source=source,
                name=name,
                count=len(model.numerator),
                denominator=str(model.denominator),
            )
    return models


def interpret_model(
    model: PrintedModel, variable: Literal["s", "z"], last_digit: float = 1e-4
) -> ModelInterpretation:
    """Interpret a printed model in ``s``, literally, or in ``z``, as a discrete identification.

    Parameters
    ----------
    model : PrintedModel
    variable : "s" or "z"
    last_digit : float
        Unit of the last printed digit. The error of each coefficient is at most half of it.

    Raises
    ------
    IdentificationSettingError
        If the variable is neither "s" nor "z".
    """
    if variable not in ("s", "z"):
        raise IdentificationSettingError(
            "reading {variable}: choose 's' or 'z'", variable=repr(variable)
        )
    poles, zeros = _find_roots(model.denominator), _find_roots(model.numerator)
    static_point = 0.0 if variable == "s" else 1.0
    pairs = _find_cancelling_pairs(poles, zeros)
    excess = len(model.denominator) - len(model.numerator)
    return ModelInterpretation(
        variable,
        poles,
        zeros,
        bool(np.all(poles.real < 0.0) if variable == "s" else np.all(np.abs(poles) < 1.0)),
        int(np.sum(np.abs(poles - static_point) < _MAX_INTEGRATOR_DISTANCE)),
        excess if variable == "z" else None,
        _compute_gain(model, static_point),
        _compute_gain_bounds(model, static_point, last_digit),
        pairs,
        _compute_gain_without_pairs(model, poles, zeros, pairs, static_point),
        CONCLUSIONS_IN_S if variable == "s" else CONCLUSIONS_IN_Z,
    )


def to_transfer_function(model: PrintedModel, rate_hz: float) -> TransferFunction:
    """Return a printed model as a discrete transfer function at an assumed sampling rate."""
    excess = len(model.denominator) - len(model.numerator)
    return TransferFunction(np.array(model.numerator), np.array(model.denominator), excess, rate_hz)


def _find_roots(coefficients: tuple[float, ...]) -> ComplexArray:
    roots = np.roots(coefficients).astype(np.complex128)
    return roots[np.argsort(-np.abs(roots), kind="stable")]


def _compute_gain(model: PrintedModel, point: float) -> float:
    return _divide(
        _evaluate_polynomial(model.numerator, point), _evaluate_polynomial(model.denominator, point)
    )


def _evaluate_polynomial(coefficients: tuple[float, ...], point: float) -> float:
    """Return the value of a polynomial, exactly zero if it is zero to rounding."""
    value = float(np.polyval(coefficients, point))
    magnitude = float(np.polyval(np.abs(coefficients), abs(point)))
    return 0.0 if abs(value) <= 1e-14 * magnitude else value


def _divide(numerator: float, denominator: float) -> float:
    if denominator == 0.0:
        return float("inf") if numerator else float("nan")
    return numerator / denominator


def _compute_gain_bounds(
    model: PrintedModel, point: float, last_digit: float
) -> tuple[float, float]:
    """Return the extremes of the gain for all coefficients that round to the printed ones.

    Coefficients of 0, 1 and −1 count as exact.
    """
    numerator, denominator = (
        _compute_value_bounds(coefficients, point, last_digit / 2.0)
        for coefficients in (model.numerator, model.denominator)
    )
    if denominator[0] <= 0.0 <= denominator[1]:
        return -np.inf, np.inf
    corners = [a / b for a in numerator for b in denominator]
    return min(corners), max(corners)


def _compute_value_bounds(
    coefficients: tuple[float, ...], point: float, max_error: float
) -> tuple[float, float]:
    powers = abs(point) ** np.arange(len(coefficients) - 1, -1, -1.0)
    inexact: FloatArray = np.array(
        [coefficient not in (0.0, 1.0, -1.0) for coefficient in coefficients], float
    )
    value, uncertainty = (
        _evaluate_polynomial(coefficients, point),
        max_error * float(powers @ inexact),
    )
    return value - uncertainty, value + uncertainty


def _find_cancelling_pairs(
    poles: ComplexArray, zeros: ComplexArray
) -> tuple[tuple[complex, complex], ...]:
    return tuple(
        (complex(pole), complex(zero))
        for pole in poles
        for zero in zeros
        if abs(pole) > 0.0 and abs(pole - zero) < _CANCELLATION_DISTANCE
    )


def _compute_gain_without_pairs(
    model: PrintedModel,
    poles: ComplexArray,
    zeros: ComplexArray,
    pairs: tuple[tuple[complex, complex], ...],
    point: float,
) -> float:
    cancelled_poles, cancelled_zeros = ([pair[side] for pair in pairs] for side in (0, 1))
    remaining_poles = [pole for pole in poles if complex(pole) not in cancelled_poles]
    remaining_zeros = [zero for zero in zeros if complex(zero) not in cancelled_zeros]
    numerator = model.numerator[0] * np.prod([point - zero for zero in remaining_zeros])
    return _divide(
        float(np.real(numerator)), float(np.real(np.prod([point - p for p in remaining_poles])))
    )
