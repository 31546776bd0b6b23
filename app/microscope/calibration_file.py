"""The TOML file with the calibration of one camera behind one objective."""

import re
from dataclasses import replace
from datetime import datetime
from pathlib import Path
from typing import Annotated, Self

import numpy as np
from pydantic import Field
from pydantic.dataclasses import dataclass

from rotemina.app.errors import MicroscopeError
from rotemina.app.settings import (
    FORBID_EXTRA_KEYS,
    NonEmptyText,
    TomlFormat,
)
from rotemina.drivers.cameras import SensorRegion
from rotemina.sim.arrays import FloatArray
from rotemina.sim.vision import StageFit, StageMap

FILE_VERSION = 1
MICRO, NANO = "micro", "nano"

FiniteNumber = Annotated[float, Field(strict=False, allow_inf_nan=False)]
PixelCount = Annotated[int, Field(strict=True, ge=1)]
PixelOffset = Annotated[int, Field(strict=True, ge=0)]
NonNegativeNumber = Annotated[float, Field(ge=0.0, allow_inf_nan=False)]


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_EXTRA_KEYS)
class CalibratedRegion:
    """The region of the sensor that was calibrated, px."""

    left: PixelOffset
    top: PixelOffset
    width: PixelCount
    height: PixelCount

    @classmethod
    def from_region(cls, region: SensorRegion) -> Self:
        """Return the calibrated region that equals the region of a picture."""
        return cls(left=region.left, top=region.top, width=region.width, height=region.height)

    def contains(self, pixel: FloatArray) -> bool:
        """Return whether a pixel (column, row) of the picture lies in the region."""
        column, row = float(pixel[0]), float(pixel[1])
        return -0.5 <= column <= self.width - 0.5 and -0.5 <= row <= self.height - 0.5


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_EXTRA_KEYS)
class StageCalibration:
    """Calibration of a stage: how it moves the tip in the picture.

    Attributes
    ----------
    date : str
        Date and time of the calibration, ISO 8601.
    matrix : (2, 2)
        Jacobian of the tip's pixel with respect to the tip's x and y in the kinematics, px/m.
    covariance : (4, 4)
        Covariance of the matrix elements in row-major order, (px/m)².
    tip_m : (3,)
        Tip position in the kinematics, m, at which the tip was seen at ``tip_px`` (2,).
    residual_px : float
        rms distance between the fit and the pictures.
    """

    date: NonEmptyText
    matrix: tuple[tuple[FiniteNumber, FiniteNumber], tuple[FiniteNumber, FiniteNumber]]
    covariance: Annotated[
        tuple[tuple[FiniteNumber, FiniteNumber, FiniteNumber, FiniteNumber], ...],
        Field(min_length=4, max_length=4),
    ]
    tip_m: tuple[FiniteNumber, FiniteNumber, FiniteNumber]
    tip_px: tuple[FiniteNumber, FiniteNumber]
    residual_px: NonNegativeNumber

    @classmethod
    def from_fit(cls, fit: StageFit, date: datetime, tip_m: FloatArray, tip_px: FloatArray) -> Self:
        """Return the stored form of a fit, with the tip's position in the machine and the picture.

        ``tip_m`` is (3,), m, and ``tip_px`` is (2,).
        """
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
            raise ValueError("the matrix must not be singular; calibrate again")

    @property
    def map(self) -> StageMap:
        """The matrix and its covariance in the form that the computations use."""
        return StageMap(np.array(self.matrix), np.array(self.covariance))

    def predict_pixel(self, tip_m: FloatArray) -> FloatArray:
        """Return the pixel (2,) at which a tip at ``tip_m`` (3,), m, should be seen."""
        displacement = np.asarray(tip_m)[:2] - np.array(self.tip_m)[:2]
        return np.array(self.tip_px) + self.map.shift_of(displacement)


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_EXTRA_KEYS)
class FocusCalibration:
    """Position of best focus along an axis, m, with its standard deviation."""

    date: NonEmptyText
    axis: NonEmptyText
    sharpest: FiniteNumber
    uncertainty: NonNegativeNumber


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_EXTRA_KEYS)
class MicroscopeCalibration:
    """The calibration of one camera behind one objective."""

    version: Annotated[int, Field(strict=True, ge=FILE_VERSION, le=FILE_VERSION)] = FILE_VERSION
    camera: NonEmptyText
    objective: NonEmptyText
    view: CalibratedRegion
    micro: StageCalibration | None = None
    nano: StageCalibration | None = None
    focus: FocusCalibration | None = None

    def get_stage(self, name: str) -> StageCalibration:
        """Return the calibration of ``micro`` or ``nano``.

        Raises
        ------
        MicroscopeError
            If that stage is not calibrated.
        """
        calibration = self.micro if name == MICRO else self.nano
        if calibration is None:
            raise MicroscopeError(
                "the {name} stage is not calibrated for objective {objective} on camera "
                "{camera}; calibrate it first",
                name=name,
                objective=repr(self.objective),
                camera=repr(self.camera),
            )
        return calibration

    def with_stage(self, name: str, stage: StageCalibration) -> "MicroscopeCalibration":
        """Return a copy in which the calibration of one stage is replaced."""
        return replace(self, micro=stage) if name == MICRO else replace(self, nano=stage)


CALIBRATION_FORMAT = TomlFormat(
    MicroscopeCalibration,
    {
        "view": CalibratedRegion,
        "micro": StageCalibration,
        "nano": StageCalibration,
        "focus": FocusCalibration,
    },
    MicroscopeError,
)


def make_calibration_path(folder: Path, camera: str, objective: str) -> Path:
    """Return the path of the calibration file of a camera behind an objective."""
    names = (re.sub(r"[^\w.+-]+", "_", name).strip("_") or "_" for name in (camera, objective))
    return folder / f"{'--'.join(names)}.toml"


def load_calibration(folder: Path, camera: str, objective: str) -> MicroscopeCalibration | None:
    """Return the stored calibration of a camera behind an objective, or None.

    Raises
    ------
    MicroscopeError
        If the file cannot be used, or belongs to another camera or objective.
    """
    path = make_calibration_path(folder, camera, objective)
    if not path.exists():
        return None
    calibration = CALIBRATION_FORMAT.load(path)
    if (calibration.camera, calibration.objective) != (camera, objective):
        raise MicroscopeError(
            "{path}: this calibration is for camera {camera} with objective "
            "{objective}, not for {other_camera} with {other_objective}; move the file "
            "away and calibrate again",
            path=path,
            camera=repr(calibration.camera),
            objective=repr(calibration.objective),
            other_camera=repr(camera),
            other_objective=repr(objective),
        )
    return calibration


def save_calibration(folder: Path, calibration: MicroscopeCalibration) -> Path:
    """Save a calibration, and return the path of its file.

    Raises
    ------
    FileWriteError
        If the file cannot be written.
    """
    path = make_calibration_path(folder, calibration.camera, calibration.objective)
    CALIBRATION_FORMAT.save(path, calibration)
    return path
