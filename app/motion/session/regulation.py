"""Feedback in a session: loops that the device closes around axes.

Loops are closed and opened while the machine rests. Only a device that is a
:class:`~rotemina.drivers.abilities.AxisRegulator` can close them, because the line to a
board delivers samples hundreds of times too late for a loop.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING

from rotemina.app.errors import RequestRefusedError
from rotemina.app.motion.device import OPERATOR, DeviceLink, LoopCommand
from rotemina.app.motion.session.admission import RequestAdmission
from rotemina.drivers.abilities import AxisRegulator
from rotemina.drivers.contract import Permit
from rotemina.sim.errors import FeedbackError
from rotemina.sim.feedback import AxisRegulation
from rotemina.sim.messages import AxisName, message
from rotemina.sim.robot import PiezoAxis, Robot

# The module that searches for gains is slow to import, and only a type of it is needed here.
if TYPE_CHECKING:
    from rotemina.sim.tuning import TuningResult


@dataclass(frozen=True, slots=True, eq=False)
class NamedRegulation:
    """A loop that has been checked for stability, and its name in records."""

    regulation: AxisRegulation
    name: str


class FeedbackLoops:
    """Feedback loops around axes."""

    def __init__(self, link: DeviceLink, admission: RequestAdmission) -> None:
        self._link = link
        self._admission = admission
        self._named_loops: Mapping[str, NamedRegulation] = MappingProxyType({})

    @property
    def applied(self) -> Mapping[str, NamedRegulation]:
        """The closed loops, by axis. Any thread may read them."""
        driver, named_loops = self._link.driver, self._named_loops
        closed_axes = driver.closed_loops if isinstance(driver, AxisRegulator) else {}
        return {axis: named_loops[axis] for axis in closed_axes if axis in named_loops}

    @property
    def limited_axes(self) -> tuple[str, ...]:
        """The axes whose loop requests more than a limit allows. Any thread may read them."""
        driver = self._link.driver
        return driver.limited_axes if isinstance(driver, AxisRegulator) else ()

    @property
    def unavailable_reason(self) -> str | None:
        """Why the device cannot close loops; None if it can."""
        driver = self._link.driver
        if isinstance(driver, AxisRegulator):
            return None
        return message(
            "engine",
            "driver {name} cannot close a loop: its samples are too infrequent and too late; "
            "use feed-forward, or the simulator",
        ).fill(name=repr(driver.name))

    def apply(self, loop: NamedRegulation, *, permit: Permit | None = None) -> None:
        """Close a loop around its axis, which stays in place; undo cannot go back past this point.

        The command of the axis becomes its measured position. An inverse in use becomes the loop's
        feed-forward.

        Raises
        ------
        RequestRefusedError
            If the device cannot close loops or the machine is not at rest, or for the same reasons
            as any move.
        """
        permit = self._admission.resolve_permit(permit)
        if self.unavailable_reason is not None:
            raise RequestRefusedError(self.unavailable_reason)
        axis = loop.regulation.axis
        with self._admission.lock:
            self._admission.refuse_unless_at_rest("closing a loop")
            self._queue_change(axis, loop.regulation, permit)
            self._named_loops = MappingProxyType({**self._named_loops, axis: loop})

    def remove(self, axis: str, *, permit: Permit | None = None) -> None:
        """Open the loop of an axis, which stays in place; undo cannot go back past this point.

        Raises
        ------
        RequestRefusedError
            See :meth:`apply`. Also if the axis has no loop.
        """
        permit = self._admission.resolve_permit(permit)
        if axis not in self.applied:
            raise RequestRefusedError("axis {axis} has no loop to open", axis=AxisName(axis))
        with self._admission.lock:
            self._admission.refuse_unless_at_rest("opening a loop")
            self._queue_change(axis, None, permit)

    def forget(self) -> None:
        """Forget all loops when another device is connected."""
        self._named_loops = MappingProxyType({})

    def _queue_change(self, axis: str, regulation: AxisRegulation | None, permit: Permit) -> None:
        self._admission.queue(LoopCommand(axis, regulation), permit, (axis,), OPERATOR)
        self._admission.undo_history.forget()


def make_regulation(robot: Robot, tuning: "TuningResult", name: str) -> NamedRegulation:
    """Return the chosen point of a tuning as a loop that may be applied to a robot.

    Raises
    ------
    FeedbackError
        If the tuning is for another robot, for an axis that is not a piezo in open loop, or for a
        loop with delayed outputs. Also if the loop is unstable on this axis of the robot, or on an
        axis that deviates from it within the tolerance of the tuning.
    EffectError
        If an effect of the robot cannot be used.
    """
    axis, source = tuning.axis, tuning.provenance
    if source.robot != robot.name:
        raise FeedbackError(
            "{name}: tuned for robot {robot}, not for {this}; tune on this robot",
            name=name,
            robot=repr(source.robot),
            this=repr(robot.name),
        )
    axis_model = robot.axes.get(axis)
    if not isinstance(axis_model, PiezoAxis) or axis_model.controller is not None:
        raise FeedbackError(
            "{name}: axis {axis} of robot {this} is not a piezo in open loop, which the loop needs",
            name=name,
            axis=AxisName(axis),
            this=repr(robot.name),
        )
    if tuning.delay:
        raise FeedbackError(
            "{name}: tuned for outputs that are {delay} intervals late, but a device's "
            "loop outputs them at once; tune with a delay of 0",
            name=name,
            delay=tuning.delay,
        )
    loop_name = f"{name}, point {tuning.chosen}"
    try:
        regulation = AxisRegulation(
            robot,
            axis,
            tuning.chosen_point.gains,
            tuning.rate_hz,
            peak_sensitivity=source.peak_sensitivity,
            spread=source.spread,
        )
    except FeedbackError as error:
        raise type(error)(
            message("engine", "{number}: {error}").fill(number=loop_name, error=str(error))
        ) from error
    return NamedRegulation(regulation, loop_name)
