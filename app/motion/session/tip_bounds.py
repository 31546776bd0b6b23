"""The bounds of the tip in a session, and teaching of the floor at rest."""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from rotemina.app.motion.device import DeviceLink
from rotemina.app.motion.limits import Guard
from rotemina.app.motion.session.admission import RequestAdmission
from rotemina.app.motion.state import SessionState
from rotemina.sim.errors import OutOfLimitsError
from rotemina.sim.kinematics import KeepOutZone
from rotemina.sim.messages import format_rounded


class _LocatedTip(NamedTuple):
    zone: KeepOutZone
    command: Mapping[str, float]
    tip: tuple[float, float, float]


class TipBounds:
    """The bounds of the tip, which the guard applies to all motion."""

    def __init__(self, link: DeviceLink, admission: RequestAdmission, guard: Guard) -> None:
        self._link = link
        self._admission = admission
        self._guard = guard
        # The position is read far more often than it changes, so the latest result is kept.
        self._latest_location: _LocatedTip | None = None

    @property
    def keep_out(self) -> KeepOutZone | None:
        """The bounds of the tip; None if the robot has no tip."""
        return self._guard.zone

    def compute_tip(self, state: SessionState) -> tuple[float, float, float] | None:
        """Return the commanded position of the tip, m, or None without a tip or a command."""
        zone, command = self._guard.zone, state.command
        if zone is None or not command:
            return None
        location = self._latest_location
        if location is None or location.zone is not zone or location.command is not command:
            x, y, z = zone.tip_at(np.array([command[axis] for axis in self._link.robot.axes]))
            location = self._latest_location = _LocatedTip(
                zone, command, (float(x), float(y), float(z))
            )
        return location.tip

    def teach_floor(self, clearance: float = 0.0) -> float:
        """Set the floor at the current height of the tip, or lower by ``clearance`` (m).

        Returns
        -------
        float
            Height of the floor, m.

        Raises
        ------
        OutOfLimitsError
            If the robot has no tip, or its tip cannot reach this height.
        RequestRefusedError
            If the machine is not at rest, or motion is locked.
        """
        if self._guard.zone is None:
            name = self._link.robot.name
            raise OutOfLimitsError("robot {name} has no tip for a floor to limit", name=repr(name))
        if not 0.0 <= clearance < float("inf"):
            raise OutOfLimitsError(
                "tip: the clearance {clearance} m below the tip must be a finite number, 0 or more",
                clearance=format_rounded(clearance, 6),
            )
        with self._admission.lock:
            self._admission.refuse_unless_at_rest("teaching the floor")
            tip = self.compute_tip(self._link.worker.state)
            assert tip is not None, "a machine that may move has a known position"
            floor = tip[2] - clearance
            self._guard.teach_floor(floor)
        return floor

    def clear_floor(self) -> None:
        """Remove the floor of the tip. The objective still bounds the tip.

        Raises
        ------
        OutOfLimitsError
            If the robot has no tip.
        RequestRefusedError
            If the machine is not at rest, or motion is locked.
        """
        with self._admission.lock:
            self._admission.refuse_unless_at_rest("removing the floor")
            self._guard.teach_floor(None)
