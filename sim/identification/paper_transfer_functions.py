"""The paper's transfer functions, Eqs. (2)-(4), and what each way of reading them allows."""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass as plain_dataclass
from importlib import resources
from typing import Literal

import numpy as np
from pydantic import TypeAdapter, ValidationError
from pydantic.dataclasses import dataclass

from rotemina.sim.arrays import ComplexArray, FloatArray
from rotemina.sim.errors import reason_of
from rotemina.sim.identification.errors import ModelFileError, SettingError
from rotemina.sim.identification.transfer_function import TransferFunction
from rotemina.sim.messages import message
from rotemina.sim.robot.numbers import FORBID_UNKNOWN, Count, Number, Positive
from rotemina.sim.robot.schema_errors import describe

SHIPPED = "rotemina.resources.models"
_NEAR = 0.01  # between a pole and a zero that all but cancel
_AT_ORIGIN = 1e-9

IN_S = (
    "Unstable: a pole at +1 rad/s and a double integrator. A constant input would drive the "
    "table away without bound, while the real one stays where it is sent.",
    "It cannot be simulated over a run, and no gain, bandwidth or damping follows from it.",
    "It shows only that 's' is not the variable in which it was identified.",
)
IN_Z = (
    "Stable: a discrete identification of sampled data, one sample of delay. The rate is not "
    "printed, so times are known in samples alone.",
    "The zero at 1 all but cancels the slow pole; what is left answers within two samples with "
    "the remaining gain a sample. The figures show no slower dynamics, and no resonance.",
    "The static gain is zero as printed, but the last digits leave even its sign open: see its "
    "bounds. Only the gain without the cancelled pair is well determined.",
)


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class PrintedModel:
    """A ratio of polynomials as printed, coefficients from the highest power down."""

    equation: Count
    axis: str
    numerator: tuple[Number, ...]
    denominator: tuple[Number, ...]


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class _Source:
    title: str
    printed_variable: str
    last_digit: Positive
    resampling_factor: Positive


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class PublishedModels:
    """A file of published models: where they are from, and each by name."""

    source: _Source
    model: Mapping[str, PrintedModel]


@plain_dataclass(frozen=True, slots=True, eq=False)
class Reading:
    """One reading of a printed model.

    Attributes
    ----------
    variable : "s" (rad/s, continuous) or "z" (discrete, per sample).
    poles, zeros : complex, largest first.
    stable : all poles left of the imaginary axis, or inside the unit circle.
    integrators : poles at 0 of s, or at 1 of z.
    delay_samples : of the reading in z (excess of poles); None in s.
    static_gain : at s = 0, or z = 1; infinite (without a sign) with an integrator.
    static_gain_bounds : lowest and highest value that rounds to the printed digits.
    cancelling : (pole, zero) pairs closer than 0.01.
    remaining_gain : static gain without those pairs; infinite with an integrator.
    conclusions : what follows, and what does not.
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


def published_models(name: str = "rotemina") -> PublishedModels:
    """Load a shipped file of models.

    Raises
    ------
    ModelFileError
        If there is none of that name, or it is not valid.
    """
    known = sorted(
        item.name[:-5] for item in resources.files(SHIPPED).iterdir() if item.name.endswith(".toml")
    )
    if name not in known:
        raise ModelFileError(
            message("engine", "{name}: no such shipped models; choose from {names}").fill(
                name=name, names=", ".join(known)
            )
        )
    text = resources.files(SHIPPED).joinpath(f"{name}.toml").read_text("utf-8")
    return parse_models(text, f"{name}.toml")


def parse_models(text: str, source: str = "model file") -> PublishedModels:
    """Read models from TOML; ``source`` names it in errors.

    Raises
    ------
    ModelFileError
        With file, key, value and bound.
    """
    try:
        models = TypeAdapter(PublishedModels).validate_python(tomllib.loads(text))
    except tomllib.TOMLDecodeError as error:
        raise ModelFileError(
            message("engine", "{source}: not valid TOML: {error}").fill(
                source=source, error=reason_of(error)
            )
        ) from error
    except ValidationError as error:
        raise ModelFileError(
            message("engine", "{source}: {describe}").fill(source=source, describe=describe(error))
        ) from error
    for name, model in models.model.items():
        short = not model.numerator or len(model.numerator) > len(model.denominator)
        if short or model.denominator[0] != 1.0:
            raise ModelFileError(
                message(
                    "engine",
                    "{source}: model.{name}: {count} coefficients over {denominator}; the "
                    "denominator must begin with 1 and be at least as long",
                ).fill(
                    source=source,
                    name=name,
                    count=len(model.numerator),
                    denominator=str(model.denominator),
                )
            )
    return models


def reading(model: PrintedModel, variable: Literal["s", "z"], last_digit: float = 1e-4) -> Reading:
    """Read a printed model in ``s`` literally, or in ``z`` as a discrete identification.

    Parameters
    ----------
    last_digit : unit of the last printed digit; each coefficient is known to half of it.
    """
    if variable not in ("s", "z"):
        raise SettingError(
            message("engine", "reading {variable}: choose 's' or 'z'").fill(variable=repr(variable))
        )
    poles, zeros = _roots(model.denominator), _roots(model.numerator)
    at = 0.0 if variable == "s" else 1.0
    pairs = _cancelling(poles, zeros)
    excess = len(model.denominator) - len(model.numerator)
    return Reading(
        variable,
        poles,
        zeros,
        bool(np.all(poles.real < 0.0) if variable == "s" else np.all(np.abs(poles) < 1.0)),
        int(np.sum(np.abs(poles - at) < _AT_ORIGIN)),
        excess if variable == "z" else None,
        _gain(model, at),
        _gain_bounds(model, at, last_digit),
        pairs,
        _remaining(model, poles, zeros, pairs, at),
        IN_S if variable == "s" else IN_Z,
    )


def as_discrete(model: PrintedModel, rate_hz: float) -> TransferFunction:
    """Return the reading in z as a transfer function at an assumed sampling rate."""
    excess = len(model.denominator) - len(model.numerator)
    return TransferFunction(np.array(model.numerator), np.array(model.denominator), excess, rate_hz)


def _roots(coefficients: tuple[float, ...]) -> ComplexArray:
    roots = np.roots(coefficients).astype(np.complex128)
    return roots[np.argsort(-np.abs(roots), kind="stable")]


def _gain(model: PrintedModel, at: float) -> float:
    return _ratio(_value(model.numerator, at), _value(model.denominator, at))


def _value(coefficients: tuple[float, ...], at: float) -> float:
    """Return the polynomial's value, zero where it is zero to rounding."""
    value = float(np.polyval(coefficients, at))
    size = float(np.polyval(np.abs(coefficients), abs(at)))
    return 0.0 if abs(value) <= 1e-14 * size else value


def _ratio(above: float, below: float) -> float:
    if below == 0.0:
        return float("inf") if above else float("nan")
    return above / below


def _gain_bounds(model: PrintedModel, at: float, last_digit: float) -> tuple[float, float]:
    """Return the extremes over coefficients rounded by half a digit; 0, 1 and −1 are exact."""
    above, below = (
        _interval(each, at, last_digit / 2.0) for each in (model.numerator, model.denominator)
    )
    if below[0] <= 0.0 <= below[1]:
        return -np.inf, np.inf
    corners = [a / b for a in above for b in below]
    return min(corners), max(corners)


def _interval(coefficients: tuple[float, ...], at: float, half: float) -> tuple[float, float]:
    powers = abs(at) ** np.arange(len(coefficients) - 1, -1, -1.0)
    rounded: FloatArray = np.array([each not in (0.0, 1.0, -1.0) for each in coefficients], float)
    value, slack = _value(coefficients, at), half * float(powers @ rounded)
    return value - slack, value + slack


def _cancelling(poles: ComplexArray, zeros: ComplexArray) -> tuple[tuple[complex, complex], ...]:
    return tuple(
        (complex(pole), complex(zero))
        for pole in poles
        for zero in zeros
        if abs(pole) > 0.0 and abs(pole - zero) < _NEAR
    )


def _remaining(
    model: PrintedModel,
    poles: ComplexArray,
    zeros: ComplexArray,
    pairs: tuple[tuple[complex, complex], ...],
    at: float,
) -> float:
    gone_poles, gone_zeros = ([pair[side] for pair in pairs] for side in (0, 1))
    left_poles = [pole for pole in poles if complex(pole) not in gone_poles]
    left_zeros = [zero for zero in zeros if complex(zero) not in gone_zeros]
    above = model.numerator[0] * np.prod([at - zero for zero in left_zeros])
    return _ratio(float(np.real(above)), float(np.real(np.prod([at - p for p in left_poles]))))
