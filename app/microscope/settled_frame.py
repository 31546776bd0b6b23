"""Pictures that are taken after the machine has come to rest, with its position.

Every run that is guided by camera pictures waits for such a picture. If the picture or the position
becomes unreliable, the wait ends with an error that gives the reason, and nothing may move.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from rotemina.app.cameras import FrameCheck, PictureState
from rotemina.app.errors import MicroscopeError
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import ConnectionState, SessionState
from rotemina.drivers.cameras import CameraFrame, SensorRegion
from rotemina.drivers.contract import DeviceState, Permit
from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import format_fixed, marked, message
from rotemina.sim.vision import Image, to_grey

#: A function that returns the newest picture, or None while there is none; it never waits.
FrameSource = Callable[[], CameraFrame | None]

# In this time vibrations decay, and an exposure that began during the motion ends.
SETTLING_TIME_S = 0.15
DEFAULT_PICTURE_COUNT = 3
CAMERA_TIMEOUT_S = 3.0
REST_TIMEOUT_S = 30.0


@dataclass(frozen=True, slots=True, eq=False)
class SettledFrame:
    """Mean picture of the machine at rest, with the positions of its axes.

    Attributes
    ----------
    image : (rows, columns)
        Mean of the pictures, in grey levels.
    command, measured : (axes,)
        Positions, m or rad, in the driver's order of axes; means over the pictures.
    """

    image: Image
    command: FloatArray
    measured: FloatArray


class SettledFrameGrabber:
    """Waits for one settled frame at a time; call :meth:`step` at about the camera's rate.

    Parameters
    ----------
    session : MotionSession
    newest_frame : callable
        Returns the camera's newest picture.
    pictures : int
        Number of pictures that are averaged.
    permit : Permit, optional
        Permit issued with the request; by default a new one.
    """

    def __init__(
        self,
        session: MotionSession,
        newest_frame: FrameSource,
        *,
        pictures: int = DEFAULT_PICTURE_COUNT,
        permit: Permit | None = None,
    ) -> None:
        self._session = session
        self._newest_frame = newest_frame
        self._picture_count = pictures
        self._region: SensorRegion | None = None
        #: Permit for every move of the run; a stop invalidates it.
        self.permit = session.permit() if permit is None else permit
        self._wait_start_s = 0.0
        self._rest_start_s: float | None = None
        # Kept for the whole run, so that a repetition of a picture before the move is noticed.
        self._frame_check = FrameCheck()
        self._restart()

    def begin(self, now_s: float) -> None:
        """Start waiting for a settled frame."""
        self._wait_start_s = now_s
        self._restart()

    def step(self, now_s: float) -> SettledFrame | None:
        """Return the settled frame if it is complete, otherwise None.

        Raises
        ------
        MicroscopeError
            If the machine was stopped, can no longer move or does not come to rest, or if the
            picture is stalled, frozen or black, or shows another region of the sensor.
        VisionError
            If the picture has a wrong shape, values that are not finite, or no contrast.
        """
        state = self._session.snapshot()
        self._require_motion_possible(state)
        if state.activity is not DeviceState.IDLE or state.queued:
            self._restart()
            if now_s - self._wait_start_s > REST_TIMEOUT_S:
                raise MicroscopeError(
                    "the machine did not come to rest within {rest_patience_s} s; check "
                    "what drives it, and start again",
                    rest_patience_s=REST_TIMEOUT_S,
                )
            return None
        if self._rest_start_s is None:
            self._rest_start_s = now_s
        self._add_picture(state)
        if len(self._images) >= self._picture_count:
            return self._average_pictures()
        waited_s = now_s - self._rest_start_s
        if waited_s > SETTLING_TIME_S + CAMERA_TIMEOUT_S:
            frozen_text = marked("engine", "frozen: it repeats earlier pictures")
            problem = frozen_text if self._frame_check.is_repeated else "stalled"
            raise MicroscopeError(
                "the camera is {what}; {count} of {pictures} new pictures arrived within "
                "{waited_s} s. Nothing moves: check the camera, and start again",
                what=problem,
                count=len(self._images),
                pictures=self._picture_count,
                waited_s=format_fixed(waited_s, 1),
            )
        return None

    def require_motion_permitted(self) -> None:
        """Raise MicroscopeError if motion is no longer permitted; call it right before every move.

        The evaluation of a picture takes a while, during which someone may stop the machine.

        Raises
        ------
        MicroscopeError
            See :meth:`step`.
        """
        self._require_motion_possible(self._session.snapshot())

    def _restart(self) -> None:
        self._rest_start_s = None
        self._images: list[Image] = []
        self._commands: list[FloatArray] = []
        self._measured: list[FloatArray] = []
        self._latest_frame: CameraFrame | None = None

    def _add_picture(self, state: SessionState) -> None:
        frame = self._newest_frame()
        assert self._rest_start_s is not None
        if frame is None or frame.host_time_s < self._rest_start_s + SETTLING_TIME_S:
            return
        previous, self._latest_frame = self._latest_frame, frame
        if previous is not None and frame.number == previous.number:
            return
        if self._region is not None and frame.region != self._region:
            raise MicroscopeError(
                "the camera shows {size}, but showed {before} at the start; keep its "
                "settings, and start again",
                size=_format_size(frame.region),
                before=_format_size(self._region),
            )
        self._region = frame.region
        if self._frame_check.classify(frame) is PictureState.BLACK:
            raise MicroscopeError(
                "the picture is black; check lamp, shutter and exposure. Nothing moves"
            )
        if self._frame_check.is_repeated:
            return
        axes = self._session.driver.axes
        self._images.append(to_grey(frame.pixels))
        self._commands.append(np.array([state.command[axis] for axis in axes]))
        self._measured.append(np.array([state.measured[axis] for axis in axes]))

    def _average_pictures(self) -> SettledFrame:
        return SettledFrame(
            image=np.mean(self._images, axis=0, dtype=np.float32),
            command=np.mean(self._commands, axis=0),
            measured=np.mean(self._measured, axis=0),
        )

    def _require_motion_possible(self, state: SessionState) -> None:
        if not self.permit.is_valid:
            raise MicroscopeError("the machine was stopped; it stays in place")
        if state.connection is not ConnectionState.CONNECTED or state.fault is not None:
            reason = state.fault or state.lock_reason or message("engine", "it is not connected")
            raise MicroscopeError("the machine no longer moves: {reason}", reason=reason)
        if state.lock_reason is not None:
            raise MicroscopeError("motion is locked: {locked}", locked=state.lock_reason)


def _format_size(region: SensorRegion) -> str:
    return message("engine", "{width} × {height} px from {left}, {top}").fill(
        width=region.width, height=region.height, left=region.left, top=region.top
    )
