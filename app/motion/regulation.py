"""Feedback in a session: loops around axes on the device, closed and opened at rest.

Only a device that is a :class:`~rotemina.drivers.model_abilities.Regulator` can: a loop needs its
samples hundreds of times sooner than a line to a board brings them.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING

from rotemina.app.motion.admission import Admission
from rotemina.app.motion.device_link import DeviceLink
from rotemina.app.motion.mailbox import RefusedError, Regulate
from rotemina.app.motion.ownership import OPERATOR
from rotemina.drivers.gate import Permit
from rotemina.drivers.model_abilities import Regulator
from rotemina.sim.feedback.errors import FeedbackError
from rotemina.sim.feedback.regulation import Regulation
from rotemina.sim.messages import AxisName, message
from rotemina.sim.robot.model import PiezoAxis, Robot

if TYPE_CHECKING:  # a search and what it needs take their time to import
    from rotemina.sim.tuning.tuning_result import Tuning


@dataclass(frozen=True, slots=True, eq=False)
class NamedRegulation:
    """A loop that was found stable, and its name in records."""

    regulation: Regulation
    name: str


class Loops:
    """Loops around axes."""

    def __init__(self, link: DeviceLink, admission: Admission) -> None:
        self._link = link
        self._admission = admission
        self._known: Mapping[str, NamedRegulation] = MappingProxyType({})

    @property
    def applied(self) -> Mapping[str, NamedRegulation]:
        """The loops that are closed, by axis; any thread."""
        driver, known = self._link.driver, self._known
        closed = driver.regulated if isinstance(driver, Regulator) else {}
        return {axis: known[axis] for axis in closed if axis in known}

    @property
    def limited(self) -> tuple[str, ...]:
        """The axes whose loop asks for more than a limit allows at present; any thread."""
        driver = self._link.driver
        return driver.regulation_limited if isinstance(driver, Regulator) else ()

    @property
    def unavailable(self) -> str | None:
        """Why the device closes no loop; None if it does."""
        driver = self._link.driver
        if isinstance(driver, Regulator):
            return None
        return message(
            "engine",
            "driver {name} cannot close a loop: its samples are too infrequent and too late; "
            "use feed-forward, or the simulator",
        ).fill(name=repr(driver.name))

    def apply(self, loop: NamedRegulation, *, permit: Permit | None = None) -> None:
        """Close a loop around its axis, which stays where it is; no way leads back from there.

        Its command becomes the position that its sensor tells. An inverse that is on goes over
        into the loop's feed-forward.

        Raises
        ------
        RefusedError
            If the device cannot, the machine is not at rest, or as for any move.
        """
        permit = self._admission.drawn(permit)
        if self.unavailable is not None:
            raise RefusedError(self.unavailable)
        axis = loop.regulation.axis
        with self._admission.lock:
            self._admission.refuse_unless_at_rest("closing a loop")
            self._change(axis, loop.regulation, permit)
            self._known = MappingProxyType({**self._known, axis: loop})

    def remove(self, axis: str, *, permit: Permit | None = None) -> None:
        """Open the loop of an axis, which stays in place; undo cannot cross this point.

        Raises
        ------
        RefusedError
            As :meth:`apply`, or if there is none.
        """
        permit = self._admission.drawn(permit)
        if axis not in self.applied:
            raise RefusedError(
                message("engine", "axis {axis} has no loop to open").fill(axis=AxisName(axis))
            )
        with self._admission.lock:
            self._admission.refuse_unless_at_rest("opening a loop")
            self._change(axis, None, permit)

    def forget(self) -> None:
        """Have none closed: another device is connected."""
        self._known = MappingProxyType({})

    def _change(self, axis: str, regulation: Regulation | None, permit: Permit) -> None:
        self._admission.queue(Regulate(axis, regulation), permit, (axis,), OPERATOR)
        self._admission.way_back.forget()


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
            message(
                "engine", "{name}: tuned for robot {robot}, not for {this}; tune on this robot"
            ).fill(name=name, robot=repr(source.robot), this=repr(robot.name))
        )
    described = robot.axes.get(axis)
    if not isinstance(described, PiezoAxis) or described.controller is not None:
        raise FeedbackError(
            message(
                "engine",
                "{name}: axis {axis} of robot {this} is not a piezo in open loop, which the"
                " loop needs",
            ).fill(name=name, axis=AxisName(axis), this=repr(robot.name))
        )
    if tuning.delay:
        raise FeedbackError(
            message(
                "engine",
                "{name}: tuned for outputs that are {delay} intervals late, but a device's "
                "loop outputs them at once; tune with a delay of 0",
            ).fill(name=name, delay=tuning.delay)
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
        raise type(error)(
            message("engine", "{number}: {error}").fill(number=number, error=str(error))
        ) from error
    return NamedRegulation(regulation, number)
