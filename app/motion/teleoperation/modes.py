"""The steering modes of a robot, in the order in which a button cycles through them."""

from collections.abc import Callable

from rotemina.app.motion.teleoperation.frames import AxesFrame, Frame, FrameError, Values
from rotemina.app.motion.teleoperation.micro_nano_axis import HybridFrame
from rotemina.app.motion.teleoperation.tip_pivot_modes import FineFrame, PivotFrame
from rotemina.sim.kinematics.chain import Chain, ChainError
from rotemina.sim.messages import message
from rotemina.sim.robot.model import Robot

#: Modes of a robot with a tip. One mode holds at a time, so fine and pivot exclude one another.
TIP_MODES: dict[str, Callable[[Chain, Values], Frame]] = {
    "hybrid": HybridFrame.at,
    "fine": FineFrame.at,
    "pivot": PivotFrame.at,
}
ALL_AXES = "axes"  # the only mode of a robot without stages


class Modes:
    """The modes of one robot: one for each stage, and those of its tip if it has one."""

    def __init__(self, robot: Robot) -> None:
        self._robot = robot
        stages = robot.stages or {ALL_AXES: tuple(robot.axes)}
        self._stages = {name: tuple(axes) for name, axes in stages.items()}
        self._chain: Chain | None
        try:
            self._chain = Chain.of(robot)
        except ChainError:
            self._chain = None
        tip = () if self._chain is None else tuple(TIP_MODES)
        self.names = (*self._stages, *(name for name in tip if name not in self._stages))

    def begin(self, name: str, joints: Values) -> Frame:
        """Begin a mode where the axes are, m or rad; nothing moves by that.

        Raises
        ------
        FrameError
            If the robot has no such mode, or the place of an axis that it needs is not known.
        """
        if name in self._stages:
            return AxesFrame(self._robot, name, self._stages[name], joints)
        if name not in self.names or self._chain is None:
            said = (
                message(
                    "engine",
                    "mode {name}: robot {robot} has no such mode (it needs the axes of the hybrid "
                    "chain); use one of {names}",
                )
                if name in TIP_MODES
                else message(
                    "engine", "mode {name}: robot {robot} has no such mode; use one of {names}"
                )
            )
            raise FrameError(
                said.fill(
                    name=repr(name), robot=repr(self._robot.name), names=", ".join(self.names)
                )
            )
        return TIP_MODES[name](self._chain, joints)

    def after(self, name: str) -> str:
        """Return the next mode, the first one after the last."""
        if name not in self.names:
            return self.names[0]
        return self.names[(self.names.index(name) + 1) % len(self.names)]
