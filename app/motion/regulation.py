"""Feedback in a session: loops that the device closes around axes, put on and taken off at rest.

Only a device that is a :class:`~rotemina.drivers.model_abilities.Regulator` can: a loop needs its
samples hundreds of times sooner than a line to a board brings them.
"""

from abc import ABC
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from rotemina.app.motion.compensation import CompensatedRequests
from rotemina.app.motion.mailbox import RefusedError, Regulate
from rotemina.app.motion.ownership import OPERATOR
from rotemina.drivers.driver import Driver
from rotemina.drivers.gate import Permit
from rotemina.drivers.model_abilities import Regulator
from rotemina.sim.feedback.errors import FeedbackError
from rotemina.sim.feedback.regulation import Regulation
from rotemina.sim.robot.model import PiezoAxis, Robot

if TYPE_CHECKING:  # a search and what it needs take their time to import
    from rotemina.sim.tuning.result import Tuning


@dataclass(frozen=True, slots=True, eq=False)
class NamedRegulation:
    """A loop that was found stable, and what a record is to call it."""

    regulation: Regulation
    name: str


class RegulatedRequests(CompensatedRequests, ABC):
    """Loops around axes.

    Parameters are those of :class:`~rotemina.app.motion.device_session.DeviceSession`.
    """

    def __init__(self, driver: Driver, **options: Any) -> None:
        super().__init__(driver, **options)
        self._regulations: Mapping[str, NamedRegulation] = MappingProxyType({})

    @property
    def regulated(self) -> Mapping[str, NamedRegulation]:
        """The loops that are closed, by axis; any thread."""
        driver, known = self.driver, self._regulations
        closed = driver.regulated if isinstance(driver, Regulator) else {}
        return {axis: known[axis] for axis in closed if axis in known}

    @property
    def regulation_limited(self) -> tuple[str, ...]:
        """The axes whose loop asks for more than a limit allows just now; any thread."""
        driver = self.driver
        return driver.regulation_limited if isinstance(driver, Regulator) else ()

    @property
    def no_regulation(self) -> str | None:
        """Why the device closes no loop; None if it does."""
        if isinstance(self.driver, Regulator):
            return None
        return (
            f"driver {self.driver.name!r} closes no loop: its samples come too seldom and too late "
            "for one; use feed-forward, or the simulator"
        )

    def regulate(self, loop: NamedRegulation, *, permit: Permit | None = None) -> None:
        """Close a loop around its axis, which stays where it is; no way leads back from there.

        Its command becomes the position that its sensor tells. An inverse that is on goes over
        into the loop's feed-forward.

        Raises
        ------
        RefusedError
            If the device cannot, the machine is not at rest, or as for any move.
        """
        permit = self._drawn(permit)
        if self.no_regulation is not None:
            raise RefusedError(self.no_regulation)
        axis = loop.regulation.axis
        with self._lock:
            self._refuse_unless_at_rest("closing a loop")
            with self._worker.ownership.claimed((axis,), OPERATOR):
                command = Regulate(axis, loop.regulation)
                self._mailbox.post(command, permit.owned((axis,), OPERATOR))
            self._regulations = MappingProxyType({**self._regulations, axis: loop})
            self._forget_way_back()

    def unregulate(self, axis: str, *, permit: Permit | None = None) -> None:
        """Open the loop of an axis, which stays where it is; no way leads back from there.

        Raises
        ------
        RefusedError
            As :meth:`regulate`, or if there is none.
        """
        permit = self._drawn(permit)
        if axis not in self.regulated:
            raise RefusedError(f"axis {axis} is under no loop that could be taken off")
        with self._lock:
            self._refuse_unless_at_rest("opening a loop")
            with self._worker.ownership.claimed((axis,), OPERATOR):
                self._mailbox.post(Regulate(axis, None), permit.owned((axis,), OPERATOR))
            self._forget_way_back()

    def use(self, driver: Driver) -> None:
        """Stop, let go of the device, and connect to another one, without any loop.

        Raises
        ------
        RefusedError
            If the other driver is for another robot.
        """
        super().use(driver)
        self._regulations = MappingProxyType({})


def regulation_of(robot: Robot, tuning: "Tuning", name: str) -> NamedRegulation:
    """Return the chosen point of a tuning as a loop that may be applied to a robot.

    Raises
    ------
    FeedbackError
        If it is for another robot, no piezo in open loop, a loop whose outputs come late, or is
        unstable on this robot's axis or on one that is off as the tuning allows for.
    EffectError
        If an effect of the robot cannot be used.
    """
    axis, source = tuning.axis, tuning.provenance
    if source.robot != robot.name:
        raise FeedbackError(
            f"{name}: tuned for robot {source.robot!r}, not for {robot.name!r}; tune on this robot"
        )
    described = robot.axes.get(axis)
    if not isinstance(described, PiezoAxis) or described.controller is not None:
        raise FeedbackError(
            f"{name}: axis {axis} is no piezo in open loop of robot {robot.name!r}; a loop is for "
            "one that is"
        )
    if tuning.delay:
        raise FeedbackError(
            f"{name}: tuned for outputs that come {tuning.delay} intervals late, and a device's "
            "loop puts them out at once; tune with a delay of 0"
        )
    number = f"{name}, point {tuning.chosen}"
    try:
        regulation = Regulation(
            robot,
            axis,
            tuning.best.gains,
            tuning.rate_hz,
            peak_sensitivity=source.peak_sensitivity,
            spread=source.spread,
        )
    except FeedbackError as error:
        raise type(error)(f"{number}: {error}") from error
    return NamedRegulation(regulation, number)
