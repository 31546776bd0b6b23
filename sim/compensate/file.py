"""The file of an axis' inverses: JSON text with all that went into it, read strictly."""

import json
from dataclasses import fields
from os import PathLike, fspath
from typing import Annotated, Any, Literal, Self

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator

from rotemina.sim.arrays import FloatArray, read_only
from rotemina.sim.compensate.errors import CompensationError
from rotemina.sim.compensate.inverse_parameters import InverseModel, Kind, Premises
from rotemina.sim.compensate.judgement import Residual
from rotemina.sim.compensate.training import Trained
from rotemina.sim.input_files import read_bytes
from rotemina.sim.messages import marked, message
from rotemina.sim.whole_files import replaced

FORMAT = 1
_MOST_BYTES = 4_000_000
_MOST = 4096  # numbers in a row of any array

Number = Annotated[float, Field(allow_inf_nan=False)]
Positive = Annotated[float, Field(gt=0.0, allow_inf_nan=False)]
NotNegative = Annotated[float, Field(ge=0.0, allow_inf_nan=False)]
Row = Annotated[list[Number], Field(max_length=_MOST)]
PositiveRow = Annotated[list[Positive], Field(max_length=_MOST)]


class _Strict(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True, frozen=True)


class _Premises(_Strict):
    plays: Annotated[list[Annotated[int, Field(ge=-1)]], Field(max_length=4)]
    centres: list[Row]
    widths: list[PositiveRow]


class _Inverse(_Strict):
    """Numbers of :class:`InverseModel`, but for axis and unit, which all have in common."""

    kind: Kind
    sample_s: Positive
    origin: Number
    command_origin: Number
    span: Positive
    desired_range: Annotated[list[Number], Field(min_length=2, max_length=2)]
    command_range: Annotated[list[Number], Field(min_length=2, max_length=2)]
    speed: Positive
    consequents: Annotated[list[Row], Field(min_length=1, max_length=_MOST)]
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
    def _fits_together(self) -> Self:
        for name in ("desired_range", "command_range"):
            low, high = getattr(self, name)
            if not low < high:
                raise ValueError(f"{name}: {low:g} must lie below {high:g}")
        plays, premises = len(self.radii), self.premises
        each = len(premises.centres[0]) if premises.centres else 1
        asked = {
            "initial": (len(self.initial), plays),
            "creep_weights": (len(self.creep_weights), len(self.creep_times_s)),
            "bend": (len(self.bend), len(self.bend_at) + 1),
            "premises.centres": (len(premises.centres), len(premises.plays)),
            "premises.widths": (len(premises.widths), len(premises.plays)),
            "consequents": (len(self.consequents), each ** len(premises.plays)),
        }
        rows = {"consequents": self.consequents}
        asked |= {
            f"{k}, row {i}": (len(r), plays + 2) for k, v in rows.items() for i, r in enumerate(v)
        }
        for name, (found, right) in asked.items():
            if found != right:
                raise ValueError(f"{name}: {found} entries where {right} belong")
        if any(len(row) != each for row in (*premises.centres, *premises.widths)):
            raise ValueError(f"premises: every row must hold {each} memberships")
        if any(play >= plays for play in premises.plays):
            raise ValueError(f"premises.plays: there are only {plays} plays")
        return self


class Source(_Strict):
    """A record that went in: its file's name, SHA-256 in hexadecimal, and rows."""

    name: str
    sha256: str
    rows: int


class _Residual(_Strict):
    rms: NotNegative
    aligned: NotNegative
    worst: NotNegative
    share: NotNegative
    mse: NotNegative
    offset: Number
    beyond: NotNegative


class Provenance(_Strict):
    """Where inverses come from: robot, records or a simulation's seed, versions of programs."""

    robot: str
    trained_on: list[Source]
    held_out: list[Source]
    seed: int | None
    versions: dict[str, str]


class _Document(_Strict):
    rotemina_inverse: Literal[1]
    axis: str
    unit: Literal["m", "rad"]
    recommended: Kind
    why: str
    remarks: list[str]
    provenance: Provenance
    residuals: dict[Kind, _Residual]
    inverses: Annotated[list[_Inverse], Field(min_length=1)]

    @model_validator(mode="after")
    def _complete(self) -> Self:
        kinds = [each.kind for each in self.inverses]
        if len(set(kinds)) != len(kinds) or set(kinds) != set(self.residuals):
            raise ValueError("inverses and residuals must be of the same kinds, each once")
        if self.recommended not in kinds:
            raise ValueError(f"recommended: there is no inverse of kind {self.recommended}")
        return self


def write_trained(path: str | PathLike[str], trained: Trained, provenance: Provenance) -> None:
    """Write the file, completely or not at all.

    Raises
    ------
    FileWriteError
        If it cannot be written.
    """
    model = trained.models[trained.chosen]
    document = {
        "rotemina_inverse": FORMAT,
        "axis": model.axis,
        "unit": model.unit,
        "recommended": trained.chosen,
        "why": trained.why,
        "remarks": list(trained.remarks),
        "provenance": provenance.model_dump(),
        "residuals": {kind: one.as_json() for kind, one in trained.residuals.items()},
        "inverses": [_plain(each) for each in trained.models.values()],
    }
    _Document.model_validate(document)  # what is written can be read
    text = json.dumps(document, ensure_ascii=False, allow_nan=False, indent=1)
    with replaced(path) as file:
        file.write(text.encode("utf-8"))


def _plain(model: InverseModel) -> dict[str, Any]:
    out: dict[str, Any] = {}
    for each in fields(model):
        value = getattr(model, each.name)
        if isinstance(value, Premises):
            value = {
                "plays": list(value.plays),
                "centres": value.centres.tolist(),
                "widths": value.widths.tolist(),
            }
        elif isinstance(value, np.ndarray):
            value = value.tolist()
        elif isinstance(value, tuple):
            value = list(value)
        if each.name not in ("axis", "unit"):
            out[each.name] = value
    return out


def read_trained(path: str | PathLike[str]) -> tuple[Trained, Provenance]:
    """Read a file that :func:`write_trained` wrote.

    Raises
    ------
    CompensationError
        If it cannot be read or is no such file, with the place and what is wrong there.
    """
    name = fspath(path)
    advice = "name a file that 'rotemina compensate train' wrote"
    data = read_bytes(path, CompensationError, _MOST_BYTES, advice=advice)
    try:
        document = _Document.model_validate_json(data)
    except ValidationError as error:
        first = error.errors(include_url=False, include_input=False)[0]
        place = ".".join(map(str, first["loc"])) or marked("engine", "the file")
        raise CompensationError(
            message(
                "engine", "{name}: {place}: {first}; train it again, or use an unchanged copy"
            ).fill(name=name, place=place, first=first["msg"])
        ) from error
    models = {each.kind: _model(document, each) for each in document.inverses}
    residuals = {kind: Residual(**one.model_dump()) for kind, one in document.residuals.items()}
    trained = Trained(models, residuals, document.recommended, tuple(document.remarks))
    return trained, document.provenance


def _model(document: _Document, read: _Inverse) -> InverseModel:
    values = {name: getattr(read, name) for name in type(read).model_fields}
    premises = read.premises
    shape = (len(premises.plays), -1) if premises.plays else (0, 1)
    values["premises"] = Premises(
        tuple(premises.plays),
        _array(premises.centres).reshape(shape),
        _array(premises.widths).reshape(shape),
    )
    for name, value in values.items():
        if isinstance(value, list):
            values[name] = tuple(value) if name.endswith("_range") else _array(value)
    return InverseModel(axis=document.axis, unit=document.unit, **values)


def _array(values: list[Any]) -> FloatArray:
    return read_only(np.array(values, dtype=np.float64))
