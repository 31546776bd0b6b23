"""The display of the machine's state, derived once per frame for all parts of the window."""

from rotemina.app.microscope import Microscope, MicroscopeActivity
from rotemina.app.motion.state import SessionState
from rotemina.app.operation import OperatorControl
from rotemina.app.workbench.playback_controller import PlaybackController
from rotemina.app.workbench.window_state import StateDisplay, WindowSnapshot, describe_state
from rotemina.sim.robot import Robot


class StateDescriber:
    """Describer of the machine, the playback, the penetration and the microscope as one state."""

    def __init__(
        self,
        robot: Robot,
        player: PlaybackController,
        operation: OperatorControl,
        microscope: Microscope,
    ) -> None:
        self._robot, self._player = robot, player
        self._operation, self._microscope = operation, microscope
        # The state of the current frame and its display.
        self._latest_display: tuple[SessionState, StateDisplay] | None = None

    def begin_frame(self, state: SessionState) -> None:
        """Compute the display of the state that is shown in this frame."""
        self._latest_display = state, describe_state(self._take_snapshot(state))

    def describe(self, state: SessionState) -> StateDisplay:
        """Return the display of a state; within a frame it is computed only once."""
        if self._latest_display is not None and self._latest_display[0] is state:
            return self._latest_display[1]
        return describe_state(self._take_snapshot(state))

    def _take_snapshot(self, state: SessionState) -> WindowSnapshot:
        activity = self._microscope.runner.activity
        return WindowSnapshot(
            self._robot,
            state,
            self._player.playback.state,
            self._player.resumption.waits_for,
            self._operation.penetration.status,
            "" if activity is MicroscopeActivity.NONE else activity,
        )
