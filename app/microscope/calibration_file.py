"""The TOML file of a calibrated camera and objective."""

import re
from dataclasses import replace
from datetime import datetime
from pathlib import Path
from typing import Annotated, Self

import numpy as np
from pydantic import Field
from pydantic.dataclasses import dataclass

from rotemina.app.microscope.errors import MicroscopeError
from rotemina.app.toml_file import STRICT, Format, Text
from rotemina.drivers.cameras.frame import Region
from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import message
from rotemina.sim.vision.calibration import StageFit, StageMap

VERSION = 1
MICRO, NANO = "micro", "nano"

Finite = Annotated[float, Field(strict=False, allow_inf_nan=False)]
Side = Annotated[int, Field(strict=True, ge=1)]
Offset = Annotated[int, Field(strict=True, ge=0)]
Residual = Annotated[float, Field(ge=0.0, allow_inf_nan=False)]


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class View:
    """The part of the sensor that was calibrated, px."""

    left: Offset
    top: Offset
    width: Side
    height: Side

    @classmethod
    def of(cls, region: Region) -> Self:
        """Return what a camera shows."""
        return cls(left=region.left, top=region.top, width=region.width, height=region.height)

    def holds(self, pixel: FloatArray) -> bool:
        """Return whether a pixel (column, row) of the picture lies in it."""
        column, row = float(pixel[0]), float(pixel[1])
        return -0.5 <= column <= self.width - 0.5 and -0.5 <= row <= self.height - 0.5


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class StageCalibration:
    """How a stage moves the tip in the picture.

    Attributes
    ----------
    date : str
        When, ISO 8601.
    matrix : (2, 2)
        px per m of the tip by x and y of the kinematics.
    covariance : (4, 4)
        Of the matrix, row after row, (px/m)².
    tip_m : (3,)
        Where the tip was by the kinematics when it was seen at ``tip_px`` (2,), m.
    residual_px : float
        rms distance between fit and pictures.
    """

    date: Text
    matrix: tuple[tuple[Finite, Finite], tuple[Finite, Finite]]
    covariance: Annotated[
        tuple[tuple[Finite, Finite, Finite, Finite], ...], Field(min_length=4, max_length=4)
    ]
    tip_m: tuple[Finite, Finite, Finite]
    tip_px: tuple[Finite, Finite]
    residual_px: Residual

    @classmethod
    def of(cls, fit: StageFit, date: datetime, tip_m: FloatArray, tip_px: FloatArray) -> Self:
        """Return the stored form of a fit, with the true and the seen position of the tip."""
        (a, b), (c, d) = fit.map.matrix.tolist()
        (x, y, z), (column, row) = tip_m.tolist(), tip_px.tolist()
        return cls(
            date=date.isoformat(timespec="seconds"),
            matrix=((a, b), (c, d)),
            covariance=tuple((p, q, r, s) for p, q, r, s in fit.map.covariance.tolist()),
            tip_m=(x, y, z),
            tip_px=(column, row),
            residual_px=fit.residual_rms,
        )

    def __post_init__(self) -> None:
        if not abs(np.linalg.det(np.array(self.matrix))) > 0.0:
            raise ValueError("the matrix must not be singular; calibrate anew")

    @property
    def map(self) -> StageMap:
        """The map in the form that the computations use."""
        return StageMap(np.array(self.matrix), np.array(self.covariance))

    def pixel_of(self, tip_m: FloatArray) -> FloatArray:
        """Return where a tip (3,), m, by the kinematics should be seen, px."""
        moved = np.asarray(tip_m)[:2] - np.array(self.tip_m)[:2]
        return np.array(self.tip_px) + self.map.pixels(moved)


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class FocusCalibration:
    """Where the picture was sharpest along an axis, m, with its standard deviation."""

    date: Text
    axis: Text
    sharpest: Finite
    uncertainty: Residual


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class MicroscopeCalibration:
    """The calibration of one camera behind one objective."""

    version: Annotated[int, Field(strict=True, ge=VERSION, le=VERSION)] = VERSION
    camera: Text
    objective: Text
    view: View
    micro: StageCalibration | None = None
    nano: StageCalibration | None = None
    focus: FocusCalibration | None = None

    def stage(self, name: str) -> StageCalibration:
        """Return the calibration of ``micro`` or ``nano``.

        Raises
        ------
        MicroscopeError
            If that stage was not calibrated.
        """
        found = self.micro if name == MICRO else self.nano
        if found is None:
            raise MicroscopeError(
                message(
                    "engine",
                    "the {name} stage is not calibrated for objective {objective} on camera "
                    "{camera}; calibrate it first",
                ).fill(name=name, objective=repr(self.objective), camera=repr(self.camera))
            )
        return found

    def with_stage(self, name: str, stage: StageCalibration) -> "MicroscopeCalibration":
        """Return all of it with another calibration of one stage."""
        return replace(self, micro=stage) if name == MICRO else replace(self, nano=stage)


FORMAT = Format(
    MicroscopeCalibration,
    {
        "view": View,
        "micro": StageCalibration,
        "nano": StageCalibration,
        "focus": FocusCalibration,
    },
    MicroscopeError,
)


def file_of(folder: Path, camera: str, objective: str) -> Path:
    """Return where the calibration of a camera behind an objective is kept."""
    names = (re.sub(r"[^\w.+-]+", "_", name).strip("_") or "_" for name in (camera, objective))
    return folder / f"{'--'.join(names)}.toml"


def load(folder: Path, camera: str, objective: str) -> MicroscopeCalibration | None:
    """Return the stored calibration of a camera behind an objective, or None.

    Raises
    ------
    MicroscopeError
        If the file cannot be used, or is of another camera.
    """
    path = file_of(folder, camera, objective)
    if not path.exists():
        return None
    found = FORMAT.load(path)
    if (found.camera, found.objective) != (camera, objective):
        raise MicroscopeError(
            message(
                "engine",
                "{path}: this calibration is for camera {camera} with objective "
                "{objective}, not for {other_camera} with {other_objective}; move the file "
                "away and calibrate again",
            ).fill(
                path=path,
                camera=repr(found.camera),
                objective=repr(found.objective),
                other_camera=repr(camera),
                other_objective=repr(objective),
            )
        )
    return found


def save(folder: Path, calibration: MicroscopeCalibration) -> Path:
    """Keep a calibration; return where.

    Raises
    ------
    FileWriteError
        If it cannot be written.
    """
    path = file_of(folder, calibration.camera, calibration.objective)
    FORMAT.save(path, calibration)
    return path
