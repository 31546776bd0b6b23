"""Calibration of an input device: raw axis values to deflections of −1 to 1, with a dead zone.

Kept in one file per device identity. A stick is described in the raw numbers of its device, so a
calibration stays true for whatever the stick is mapped to.
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

from rotemina.app.toml_file import STRICT, Format, Switch, Text
from rotemina.drivers.inputs.device import InputIdentity
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message

logger = logging.getLogger(__name__)

DEAD_ZONE = 0.08  # of a device that was never calibrated
SMALLEST_WAY = 0.02  # beyond the dead zone, raw: a potentiometer may turn by a few degrees only

Raw = Annotated[float, Field(strict=True, allow_inf_nan=False, ge=-1, le=1)]


class CalibrationError(InputError):
    """A calibration that cannot be used, or a stick that cannot be calibrated."""


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class AxisCalibration:
    """One axis of a device, in its raw numbers (−1 to 1 of the range that it declares).

    Attributes
    ----------
    low, centre, high : float
        Where it ends and where it rests. If it rests at an end (a trigger), that end equals
        ``centre``, and the deflection goes from 0 to 1, or to −1 if it rests at the high end.
    dead_zone : float
        Half the width of the range about the centre in which it counts as centred.
    expo : float
        Response curve, 0 (linear) to 1 (cubic).
    inverted : bool
        Whether the deflection has the other sign.
    travel_m : float or None
        Way of the grip from its rest to an end, m; None where nobody measured it.
    """

    low: Raw = -1.0
    centre: Raw = 0.0
    high: Raw = 1.0
    dead_zone: Annotated[float, Field(strict=True, ge=0.001, le=0.5)] = DEAD_ZONE
    expo: Annotated[float, Field(strict=True, ge=0, le=1)] = 0.0
    inverted: Switch = False
    travel_m: Annotated[float, Field(strict=True, ge=1e-4, le=1.0)] | None = None

    def __post_init__(self) -> None:
        if not self.low <= self.centre <= self.high:
            raise ValueError(
                f"low {self.low:g}, centre {self.centre:g} and high {self.high:g} must rise"
            )
        sides = (self.centre - self.low, self.high - self.centre)
        least = self.dead_zone + SMALLEST_WAY
        if max(sides) < least or any(0 < side < least for side in sides):
            raise ValueError(
                f"from centre {self.centre:g} to low {self.low:g} and to high {self.high:g} must "
                f"be at least {least:g} (dead_zone + {SMALLEST_WAY:g}) each; a trigger's rest is "
                "exactly at one end"
            )

    def deflection(self, raw: float) -> float:
        """Return −1 to 1: 0 in the dead zone, ±1 from the ends on, continuous and monotone.

        With ``s`` the share of the way from the dead zone to the end, ``s (1 − e (1 − s²))``,
        which for the expo ``e`` is the usual mix ``(1 − e) s + e s³``.
        """
        offset = raw - self.centre
        side = self.high - self.centre if offset > 0 else self.centre - self.low
        beyond = abs(offset) - self.dead_zone
        if not beyond > 0 or side == 0:  # nor for a number that is none
            return 0.0
        share = min(beyond / (side - self.dead_zone), 1.0)
        shaped = share * (1.0 - self.expo * (1.0 - share**2))
        return shaped if (offset > 0) is not self.inverted else -shaped

    def at_end(self, raw: float) -> bool:
        """Whether it is at an end that is not its rest."""
        return abs(self.deflection(raw)) == 1.0


UNCALIBRATED = AxisCalibration()


def uncalibrated(deflection: float) -> float:
    """Return what an axis that was never calibrated says at a deflection, −1 to 1."""
    way = copysign(DEAD_ZONE + (1.0 - DEAD_ZONE) * abs(deflection), deflection)
    return way if deflection else 0.0


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class Calibration:
    """The calibration of one device; an axis that is not in it has the defaults."""

    device: Text
    axes: Mapping[Text, AxisCalibration] = field(default_factory=dict)

    def axis(self, name: str) -> AxisCalibration:
        """Return how an axis is calibrated."""
        return self.axes.get(name, UNCALIBRATED)

    def with_axes(self, axes: Mapping[str, AxisCalibration]) -> "Calibration":
        """Return it with some axes calibrated again."""
        return Calibration(device=self.device, axes=MappingProxyType({**self.axes, **axes}))


_FORMAT = Format(Calibration, {"axes": AxisCalibration}, CalibrationError)


class CalibrationFolder:
    """The calibrations of all devices, one file each.

    Parameters
    ----------
    folder : Path
        It need not exist.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def path(self, identity: InputIdentity) -> Path:
        """Return the file of a device: its key in letters that every file system takes."""
        digest = hashlib.sha256(identity.key.encode()).hexdigest()[:8]
        readable = re.sub(r"[^A-Za-z0-9-]+", "_", identity.key)[:60]
        return self._folder / f"{readable}-{digest}.toml"

    def load(self, identity: InputIdentity) -> Calibration:
        """Return the calibration of a device; defaults, with a warning, if its file is bad."""
        try:
            return self.read(identity)
        except CalibrationError as error:
            logger.warning("%s; the device is used uncalibrated", error)
            return Calibration(device=identity.key)

    def read(self, identity: InputIdentity) -> Calibration:
        """Return the calibration of a device, the defaults if there is no file.

        Raises
        ------
        CalibrationError
            With file, key, value and bound.
        """
        path = self.path(identity)
        if not path.exists():
            return Calibration(device=identity.key)
        found = _FORMAT.load(path)
        if found.device != identity.key:
            raise CalibrationError(
                message(
                    "engine",
                    "{path}: device = {device}: this is the file of {key}; calibrate the device "
                    "again",
                ).fill(path=path, device=repr(found.device), key=repr(identity.key))
            )
        return found

    def save(self, identity: InputIdentity, calibration: Calibration) -> Path:
        """Write the file of a device, completely or not at all, and return where it is.

        Raises
        ------
        CalibrationError
            If it is the calibration of another device.
        FileWriteError
            If it cannot be written.
        """
        if calibration.device != identity.key:
            raise CalibrationError(
                message("engine", "the calibration of {device} cannot be stored for {key}").fill(
                    device=repr(calibration.device), key=repr(identity.key)
                )
            )
        path = self.path(identity)
        _FORMAT.save(path, calibration)
        return path
