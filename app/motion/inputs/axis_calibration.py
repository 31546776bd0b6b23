"""Calibration of an input device: raw axis values to deflections of −1 to 1, with a dead zone.

Each device has one calibration file. It describes the axes in raw values of the device, so it does
not depend on the mapping of the axes.
"""

import hashlib
import logging
import re
from collections.abc import Mapping
from dataclasses import field
from math import copysign
from pathlib import Path
from types import MappingProxyType
from typing import Annotated

from pydantic import Field
from pydantic.dataclasses import dataclass

from rotemina.app.errors import InputCalibrationError
from rotemina.app.settings import (
    FORBID_EXTRA_KEYS,
    NonEmptyText,
    StrictBool,
    TomlFormat,
)
from rotemina.drivers.inputs import InputIdentity

logger = logging.getLogger(__name__)

# Dead zone of a device that was never calibrated, in raw values.
DEFAULT_DEAD_ZONE = 0.08
# Smallest travel from the dead zone to an end, in raw values. It is small because a potentiometer
# may turn by only a few degrees.
MIN_RAW_TRAVEL = 0.02

RawValue = Annotated[float, Field(strict=True, allow_inf_nan=False, ge=-1, le=1)]


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_EXTRA_KEYS)
class InputAxisCalibration:
    """Calibration of one axis, in raw values of the device (−1 to 1 over its declared range).

    Attributes
    ----------
    low, centre, high : float
        Ends and rest position. If the axis rests at an end (a trigger), that end equals
        ``centre``, and the deflection goes from 0 to 1, or to −1 if it rests at the high end.
    dead_zone : float
        Half the width of the range about the centre in which the axis counts as centred.
    expo : float
        Response curve, 0 (linear) to 1 (cubic).
    inverted : bool
        Whether the sign of the deflection is reversed.
    travel_m : float or None
        Travel of the grip from its rest to an end, m; None if it was not measured.
    """

    low: RawValue = -1.0
    centre: RawValue = 0.0
    high: RawValue = 1.0
    dead_zone: Annotated[float, Field(strict=True, ge=0.001, le=0.5)] = DEFAULT_DEAD_ZONE
    expo: Annotated[float, Field(strict=True, ge=0, le=1)] = 0.0
    inverted: StrictBool = False
    travel_m: Annotated[float, Field(strict=True, ge=1e-4, le=1.0)] | None = None

    def __post_init__(self) -> None:
        if not self.low <= self.centre <= self.high:
            raise ValueError(
                f"low {self.low:g}, centre {self.centre:g} and high {self.high:g} must be in "
                "rising order"
            )
        sides = (self.centre - self.low, self.high - self.centre)
        min_side = self.dead_zone + MIN_RAW_TRAVEL
        if max(sides) < min_side or any(0 < side < min_side for side in sides):
            raise ValueError(
                f"from centre {self.centre:g} to low {self.low:g} and to high {self.high:g} must "
                f"be at least {min_side:g} (dead_zone + {MIN_RAW_TRAVEL:g}) each; a trigger's rest "
                "is exactly at one end"
            )

    def compute_deflection(self, raw: float) -> float:
        """Return the deflection, −1 to 1: 0 in the dead zone and ±1 at or beyond the ends.

        The deflection is continuous and monotonic. If ``s`` is the fraction of the travel from the
        dead zone to the end, it is ``s (1 − e (1 − s²))``. This is the usual mix ``(1 − e) s + e
        s³`` for the expo ``e``.
        """
        offset = raw - self.centre
        side = self.high - self.centre if offset > 0 else self.centre - self.low
        distance = abs(offset) - self.dead_zone
        # Written this way, the condition is also true for NaN.
        if not distance > 0 or side == 0:
            return 0.0
        fraction = min(distance / (side - self.dead_zone), 1.0)
        magnitude = fraction * (1.0 - self.expo * (1.0 - fraction**2))
        return magnitude if (offset > 0) is not self.inverted else -magnitude

    def is_at_end(self, raw: float) -> bool:
        """Return whether a raw value is at an end that is not the rest position."""
        return abs(self.compute_deflection(raw)) == 1.0


DEFAULT_AXIS_CALIBRATION = InputAxisCalibration()


def to_uncalibrated_raw(deflection: float) -> float:
    """Return the raw value at which an uncalibrated axis has a deflection, −1 to 1."""
    raw = copysign(DEFAULT_DEAD_ZONE + (1.0 - DEFAULT_DEAD_ZONE) * abs(deflection), deflection)
    return raw if deflection else 0.0


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_EXTRA_KEYS)
class InputCalibration:
    """Calibration of one device. Axes without an entry use the defaults."""

    device: NonEmptyText
    axes: Mapping[NonEmptyText, InputAxisCalibration] = field(default_factory=dict)

    def find_axis(self, name: str) -> InputAxisCalibration:
        """Return the calibration of an axis."""
        return self.axes.get(name, DEFAULT_AXIS_CALIBRATION)

    def with_axes(self, axes: Mapping[str, InputAxisCalibration]) -> "InputCalibration":
        """Return a copy in which some axes are replaced or added."""
        return InputCalibration(device=self.device, axes=MappingProxyType({**self.axes, **axes}))


_FILE_FORMAT = TomlFormat(InputCalibration, {"axes": InputAxisCalibration}, InputCalibrationError)


class InputCalibrationFolder:
    """Folder of the calibrations of all devices, one file each.

    Parameters
    ----------
    folder : Path
        The folder does not need to exist.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def make_path(self, identity: InputIdentity) -> Path:
        """Return the path of a device's file, with a name that every file system accepts."""
        digest = hashlib.sha256(identity.key.encode()).hexdigest()[:8]
        readable = re.sub(r"[^A-Za-z0-9-]+", "_", identity.key)[:60]
        return self._folder / f"{readable}-{digest}.toml"

    def load_or_default(self, identity: InputIdentity) -> InputCalibration:
        """Return the calibration of a device; log a warning and use defaults if it is invalid."""
        try:
            return self.read(identity)
        except InputCalibrationError as error:
            logger.warning("%s; the device is used uncalibrated", error)
            return InputCalibration(device=identity.key)

    def read(self, identity: InputIdentity) -> InputCalibration:
        """Return the calibration of a device, or the defaults if there is no file.

        Raises
        ------
        InputCalibrationError
            If the file is invalid. The message names file, key, value and bound.
        """
        path = self.make_path(identity)
        if not path.exists():
            return InputCalibration(device=identity.key)
        calibration = _FILE_FORMAT.load(path)
        if calibration.device != identity.key:
            raise InputCalibrationError(
                "{path}: device = {device}: this is the file of {key}; calibrate the device again",
                path=path,
                device=repr(calibration.device),
                key=repr(identity.key),
            )
        return calibration

    def save(self, identity: InputIdentity, calibration: InputCalibration) -> Path:
        """Write the file of a device atomically, and return its path.

        Raises
        ------
        InputCalibrationError
            If the calibration belongs to another device.
        FileWriteError
            If the file cannot be written.
        """
        if calibration.device != identity.key:
            raise InputCalibrationError(
                "the calibration of {device} cannot be stored for {key}",
                device=repr(calibration.device),
                key=repr(identity.key),
            )
        path = self.make_path(identity)
        _FILE_FORMAT.save(path, calibration)
        return path
