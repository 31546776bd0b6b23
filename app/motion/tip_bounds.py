"""The bounds of the tip in a session, and teaching of the floor at rest."""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from rotemina.app.motion.admission import Admission
from rotemina.app.motion.device_link import DeviceLink
from rotemina.app.motion.guard import Guard
from rotemina.app.motion.state import SessionState
from rotemina.sim.kinematics.keep_out import KeepOutZone
from rotemina.sim.messages import message
from rotemina.sim.quantities import rounded
from rotemina.sim.trajectory.axis_limits import OutOfLimitsError


class _Located(NamedTuple):
    """Where the tip is, m, by which bounds and which commands."""

    zone: KeepOutZone
    command: Mapping[str, float]
    tip: tuple[float, float, float]


class TipBounds:
    """The keep-out zone that the guard holds motion against."""

    def __init__(self, link: DeviceLink, admission: Admission, guard: Guard) -> None:
        self._link = link
        self._admission = admission
        self._guard = guard
        self._known: _Located | None = None  # asked for far oftener than it changes

    @property
    def keep_out(self) -> KeepOutZone | None:
        """The tip's bounds; None where the robot has no tip."""
        return self._guard.zone

    def tip(self, state: SessionState) -> tuple[float, float, float] | None:
        """Return the commanded position of the tip, m; None if there is no tip."""
        zone, command = self._guard.zone, state.command
        if zone is None or not command:
            return None
        known = self._known
        if known is None or known.zone is not zone or known.command is not command:
            x, y, z = zone.tip(np.array([command[axis] for axis in self._link.robot.axes]))
            known = self._known = _Located(zone, command, (float(x), float(y), float(z)))
        return known.tip

    def teach_floor(self, clearance: float = 0.0) -> float:
        """Put the tip's floor where the tip is now, or that much lower; return its height, m.

        Raises
        ------
        OutOfLimitsError
            If the robot has no tip, or the height is none that the tip can have.
        RefusedError
            If the machine is not at rest, or motion is locked.
        """
        if self._guard.zone is None:
            name = self._link.robot.name
            raise OutOfLimitsError(
                message("engine", "robot {name} has no tip for a floor to limit").fill(
                    name=repr(name)
                )
            )
        if not 0.0 <= clearance < float("inf"):
            raise OutOfLimitsError(
                message(
                    "engine",
                    "tip: clearance {clearance} m below the tip: must be a finite number, 0 "
                    "or more",
                ).fill(clearance=rounded(clearance, 6))
            )
        with self._admission.lock:
            self._admission.refuse_unless_at_rest("teaching the floor")
            tip = self.tip(self._link.worker.state)
            assert tip is not None, "a machine that may move has said where it is"
            floor = tip[2] - clearance
            self._guard.teach_floor(floor)
        return floor

    def clear_floor(self) -> None:
        """Remove the tip's floor; the objective remains a bound.

        Raises
        ------
        OutOfLimitsError
            If the robot has no tip.
        RefusedError
            If the machine is not at rest, or motion is locked.
        """
        with self._admission.lock:
            self._admission.refuse_unless_at_rest("removing the floor")
            self._guard.teach_floor(None)
