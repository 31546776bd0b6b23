"""Steering modes of a robot, in the order in which a button cycles through them."""

from collections.abc import Callable

from rotemina.app.errors import FrameError
from rotemina.app.motion.teleoperation.frames import AxesFrame, NamedValues, SteeringFrame
from rotemina.app.motion.teleoperation.micro_nano_axis import HybridFrame
from rotemina.app.motion.teleoperation.tip_pivot_modes import FineFrame, PivotFrame
from rotemina.sim.errors import ChainError
from rotemina.sim.kinematics import KinematicChain
from rotemina.sim.messages import message
from rotemina.sim.robot import Robot

#: Modes of a robot with a tip. Only one mode is active at a time.
TIP_MODES: dict[str, Callable[[KinematicChain, NamedValues], SteeringFrame]] = {
    "hybrid": HybridFrame.begin_at,
    "fine": FineFrame.begin_at,
    "pivot": PivotFrame.begin_at,
}
# The only mode of a robot without stages.
ALL_AXES_MODE = "axes"


class SteeringModes:
    """Modes of one robot: one for each stage, and the tip modes if the robot has a tip."""

    def __init__(self, robot: Robot) -> None:
        self._robot = robot
        stages = robot.stages or {ALL_AXES_MODE: tuple(robot.axes)}
        self._stages = {name: tuple(axes) for name, axes in stages.items()}
        self._chain: KinematicChain | None
        try:
            self._chain = KinematicChain.of(robot)
        except ChainError:
            self._chain = None
        tip_modes = () if self._chain is None else tuple(TIP_MODES)
        self.names = (*self._stages, *(name for name in tip_modes if name not in self._stages))

    def begin_mode(self, name: str, joints: NamedValues) -> SteeringFrame:
        """Return the frame of a mode, which begins at the current joints, m or rad.

        Raises
        ------
        FrameError
            If the robot does not have the mode, or the position of a needed axis is not known.
        """
        if name in self._stages:
            return AxesFrame(self._robot, name, self._stages[name], joints)
        if name not in self.names or self._chain is None:
            refusal = (
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
                refusal.fill(
                    name=repr(name), robot=repr(self._robot.name), names=", ".join(self.names)
                )
            )
        return TIP_MODES[name](self._chain, joints)

    def find_next(self, name: str) -> str:
        """Return the mode that follows a mode when a button cycles through them."""
        if name not in self.names:
            return self.names[0]
        return self.names[(self.names.index(name) + 1) % len(self.names)]
