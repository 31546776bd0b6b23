"""The file of an axis' inverses: JSON text with their provenance, validated strictly on reading."""

import json
from dataclasses import fields
from os import PathLike, fspath
from typing import Annotated, Any, Literal, Self

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator

from rotemina.sim.arrays import FloatArray, make_read_only
from rotemina.sim.compensate.inverse_parameters import InverseKind, InverseModel, RulePremises
from rotemina.sim.compensate.judgement import InverseResidual
from rotemina.sim.compensate.training import TrainingResult
from rotemina.sim.errors import CompensationError
from rotemina.sim.files import read_bytes, replace_file
from rotemina.sim.messages import marked

FILE_FORMAT = 1
_MAX_BYTES = 4_000_000
# Limit for a row of any array.
_MAX_ROW_LENGTH = 4096

Number = Annotated[float, Field(allow_inf_nan=False)]
Positive = Annotated[float, Field(gt=0.0, allow_inf_nan=False)]
NotNegative = Annotated[float, Field(ge=0.0, allow_inf_nan=False)]
Row = Annotated[list[Number], Field(max_length=_MAX_ROW_LENGTH)]
PositiveRow = Annotated[list[Positive], Field(max_length=_MAX_ROW_LENGTH)]


class _StrictModel(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True, frozen=True)


class _Premises(_StrictModel):
    plays: Annotated[list[Annotated[int, Field(ge=-1)]], Field(max_length=4)]
    centres: list[Row]
    widths: list[PositiveRow]


class _Inverse(_StrictModel):
    """The fields of :class:`InverseModel` without axis and unit, which all inverses share."""

    kind: InverseKind
    sample_s: Positive
    origin: Number
    command_origin: Number
    span: Positive
    desired_range: Annotated[list[Number], Field(min_length=2, max_length=2)]
    command_range: Annotated[list[Number], Field(min_length=2, max_length=2)]
    speed: Positive
    consequents: Annotated[list[Row], Field(min_length=1, max_length=_MAX_ROW_LENGTH)]
    radii: PositiveRow
    initial: Row
    premises: _Premises
    lag_s: NotNegative
    mode_s2: NotNegative
    creep_times_s: PositiveRow
    creep_weights: Row
    bend_offset: Number
    bend_at: Row
    bend: Annotated[Row, Field(min_length=1)]

    @model_validator(mode="after")
    def _check_consistency(self) -> Self:
        for name in ("desired_range", "command_range"):
            low, high = getattr(self, name)
            if not low < high:
                raise ValueError(f"{name}: {low:g} must lie below {high:g}")
        plays, premises = len(self.radii), self.premises
        membership_count = len(premises.centres[0]) if premises.centres else 1
        counts = {
            "initial": (len(self.initial), plays),
            "creep_weights": (len(self.creep_weights), len(self.creep_times_s)),
            "bend": (len(self.bend), len(self.bend_at) + 1),
            "premises.centres": (len(premises.centres), len(premises.plays)),
            "premises.widths": (len(premises.widths), len(premises.plays)),
            "consequents": (len(self.consequents), membership_count ** len(premises.plays)),
        }
        rows = {"consequents": self.consequents}
        counts |= {
            f"{k}, row {i}": (len(r), plays + 2) for k, v in rows.items() for i, r in enumerate(v)
        }
        for name, (actual, expected) in counts.items():
            if actual != expected:
                raise ValueError(f"{name}: {actual} entries instead of {expected}")
        if any(len(row) != membership_count for row in (*premises.centres, *premises.widths)):
            raise ValueError(f"premises: every row must hold {membership_count} memberships")
        if any(play >= plays for play in premises.plays):
            raise ValueError(f"premises.plays: there are only {plays} plays")
        return self


class InverseSource(_StrictModel):
    """A record that was used: the name of its file, SHA-256 in hexadecimal, and its rows."""

    name: str
    sha256: str
    rows: int


class _Residual(_StrictModel):
    rms: NotNegative
    aligned: NotNegative
    worst: NotNegative
    share: NotNegative
    mse: NotNegative
    offset: Number
    beyond: NotNegative


class InverseProvenance(_StrictModel):
    """Origin of inverses: robot, records or seed of a simulation, and versions of programs."""

    robot: str
    trained_on: list[InverseSource]
    held_out: list[InverseSource]
    seed: int | None
    versions: dict[str, str]


class _Document(_StrictModel):
    rotemina_inverse: Literal[1]
    axis: str
    unit: Literal["m", "rad"]
    recommended: InverseKind
    why: str
    remarks: list[str]
    provenance: InverseProvenance
    residuals: dict[InverseKind, _Residual]
    inverses: Annotated[list[_Inverse], Field(min_length=1)]

    @model_validator(mode="after")
    def _check_kinds(self) -> Self:
        kinds = [inverse.kind for inverse in self.inverses]
        if len(set(kinds)) != len(kinds) or set(kinds) != set(self.residuals):
            raise ValueError("inverses and residuals must be of the same kinds, each once")
        if self.recommended not in kinds:
            raise ValueError(f"recommended: there is no inverse of kind {self.recommended}")
        return self


def write_trained(
    path: str | PathLike[str], trained: TrainingResult, provenance: InverseProvenance
) -> None:
    """Write the file completely or not at all.

    Raises
    ------
    FileWriteError
        If the file cannot be written.
    """
    model = trained.models[trained.recommended_kind]
    document = {
        "rotemina_inverse": FILE_FORMAT,
        "axis": model.axis,
        "unit": model.unit,
        "recommended": trained.recommended_kind,
        "why": trained.recommendation_reason,
        "remarks": list(trained.remarks),
        "provenance": provenance.model_dump(),
        "residuals": {kind: residual.as_json() for kind, residual in trained.residuals.items()},
        "inverses": [_to_json_values(inverse) for inverse in trained.models.values()],
    }
    # Never write a file that could not be read again.
    _Document.model_validate(document)
    text = json.dumps(document, ensure_ascii=False, allow_nan=False, indent=1)
    with replace_file(path) as file:
        file.write(text.encode("utf-8"))


def _to_json_values(model: InverseModel) -> dict[str, Any]:
    values: dict[str, Any] = {}
    for field in fields(model):
        value = getattr(model, field.name)
        if isinstance(value, RulePremises):
            value = {
                "plays": list(value.plays),
                "centres": value.centres.tolist(),
                "widths": value.widths.tolist(),
            }
        elif isinstance(value, np.ndarray):
            value = value.tolist()
        elif isinstance(value, tuple):
            value = list(value)
        if field.name not in ("axis", "unit"):
            values[field.name] = value
    return values


def read_trained(path: str | PathLike[str]) -> tuple[TrainingResult, InverseProvenance]:
    """Read a file that :func:`write_trained` wrote.

    Raises
    ------
    CompensationError
        If the file cannot be read or has invalid content. The message names the place in the file.
    """
    name = fspath(path)
    advice = "name a file that 'rotemina compensate train' wrote"
    data = read_bytes(path, CompensationError, _MAX_BYTES, advice=advice)
    try:
        document = _Document.model_validate_json(data)
    except ValidationError as error:
        first_error = error.errors(include_url=False, include_input=False)[0]
        place = ".".join(map(str, first_error["loc"])) or marked("engine", "the file")
        raise CompensationError(
            "{name}: {place}: {first}; train it again, or use an unchanged copy",
            name=name,
            place=place,
            first=first_error["msg"],
        ) from error
    models = {inverse.kind: _make_model(document, inverse) for inverse in document.inverses}
    residuals = {
        kind: InverseResidual(**residual.model_dump())
        for kind, residual in document.residuals.items()
    }
    trained = TrainingResult(models, residuals, document.recommended, tuple(document.remarks))
    return trained, document.provenance


def _make_model(document: _Document, stored: _Inverse) -> InverseModel:
    values = {name: getattr(stored, name) for name in type(stored).model_fields}
    premises = stored.premises
    shape = (len(premises.plays), -1) if premises.plays else (0, 1)
    values["premises"] = RulePremises(
        tuple(premises.plays),
        _make_array(premises.centres).reshape(shape),
        _make_array(premises.widths).reshape(shape),
    )
    for name, value in values.items():
        if isinstance(value, list):
            values[name] = tuple(value) if name.endswith("_range") else _make_array(value)
    return InverseModel(axis=document.axis, unit=document.unit, **values)


def _make_array(values: list[Any]) -> FloatArray:
    return make_read_only(np.array(values, dtype=np.float64))
