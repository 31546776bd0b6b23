"""Pictures taken after the machine came to rest, with its position.

Whoever moves by what a camera shows waits here. Anything that makes the picture or the place
doubtful ends the wait with the reason: then nothing is to move.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from rotemina.app.cameras.frame_check import FrameCheck, PictureState
from rotemina.app.microscope.errors import MicroscopeError
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import Connection, SessionState
from rotemina.drivers.cameras.frame import Frame, Region
from rotemina.drivers.gate import Permit
from rotemina.drivers.samples import DeviceState
from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import marked, message
from rotemina.sim.quantities import fixed
from rotemina.sim.vision.image import Image, grey

#: Return the newest picture, or None while there is none; never waits.
Newest = Callable[[], Frame | None]

SETTLE_S = 0.15  # after the machine came to rest: vibrations, and a picture in exposure
PICTURES = 3
PATIENCE_S = 3.0  # with a camera
REST_PATIENCE_S = 30.0  # with a machine


@dataclass(frozen=True, slots=True, eq=False)
class SettledFrame:
    """Pictures of a machine at rest, with its position.

    Attributes
    ----------
    image : (rows, columns)
        Mean of the pictures, as one plane.
    command, measured : (axes,)
        m or rad, in the driver's order; means over the look.
    """

    image: Image
    command: FloatArray
    measured: FloatArray


class SettledFrameGrabber:
    """Waits for one settled frame at a time; call :meth:`step` at about the camera's rate.

    Parameters
    ----------
    session : MotionSession
    newest : callable
        The camera's newest picture.
    pictures : int
        How many are averaged.
    permit : Permit, optional
        Of the request that led here; drawn now without it.
    """

    def __init__(
        self,
        session: MotionSession,
        newest: Newest,
        *,
        pictures: int = PICTURES,
        permit: Permit | None = None,
    ) -> None:
        self._session = session
        self._newest = newest
        self._pictures = pictures
        self._region: Region | None = None
        #: Drawn when it began; every move of what looks goes with it, and a stop ends them all.
        self.permit = session.permit() if permit is None else permit
        self._begun_s = 0.0
        self._rested_s: float | None = None
        self._frame_check = FrameCheck()  # also knows the pictures from before a move
        self._restart()

    def begin(self, now_s: float) -> None:
        """Wait for the next rest."""
        self._begun_s = now_s
        self._restart()

    def step(self, now_s: float) -> SettledFrame | None:
        """Return the settled frame as soon as there is one.

        Raises
        ------
        MicroscopeError
            If someone stopped the machine, it cannot move any more or does not come to rest, or
            the camera stands still, is black, or shows another part of its sensor.
        VisionError
            If the picture is none.
        """
        state = self._session.snapshot()
        self._refuse_if_broken(state)
        if state.activity is not DeviceState.IDLE or state.queued:
            self._restart()
            if now_s - self._begun_s > REST_PATIENCE_S:
                raise MicroscopeError(
                    message(
                        "engine",
                        "the machine did not come to rest within {rest_patience_s} s; check "
                        "what drives it, and start again",
                    ).fill(rest_patience_s=REST_PATIENCE_S)
                )
            return None
        if self._rested_s is None:
            self._rested_s = now_s
        self._take(state)
        if len(self._images) >= self._pictures:
            return self._seen()
        waited_s = now_s - self._rested_s
        if waited_s > SETTLE_S + PATIENCE_S:
            frozen = marked("engine", "frozen: it repeats earlier pictures")
            what = frozen if self._frame_check.is_repeated else "stalled"
            raise MicroscopeError(
                message(
                    "engine",
                    "the camera is {what}; {count} of {pictures} new pictures arrived within "
                    "{waited_s} s. Nothing moves: check the camera, and start again",
                ).fill(
                    what=what,
                    count=len(self._images),
                    pictures=self._pictures,
                    waited_s=fixed(waited_s, 1),
                )
            )
        return None

    def check(self) -> None:
        """Refuse if motion is no longer permitted; to be called right before every move.

        What is computed from a picture takes a while, in which someone may stop the machine.

        Raises
        ------
        MicroscopeError
            As :meth:`step`.
        """
        self._refuse_if_broken(self._session.snapshot())

    def _restart(self) -> None:
        self._rested_s = None
        self._images: list[Image] = []
        self._commands: list[FloatArray] = []
        self._measured: list[FloatArray] = []
        self._latest: Frame | None = None

    def _take(self, state: SessionState) -> None:
        """Keep the newest picture, if it is a new one that was taken at rest."""
        frame = self._newest()
        assert self._rested_s is not None
        if frame is None or frame.host_time_s < self._rested_s + SETTLE_S:
            return
        before, self._latest = self._latest, frame
        if before is not None and frame.number == before.number:
            return
        if self._region is not None and frame.region != self._region:
            raise MicroscopeError(
                message(
                    "engine",
                    "the camera shows {size}, but showed {before} at the start; keep its "
                    "settings, and start again",
                ).fill(size=_size(frame.region), before=_size(self._region))
            )
        self._region = frame.region
        if self._frame_check.judge(frame) is PictureState.BLACK:
            raise MicroscopeError(
                message(
                    "engine",
                    "the picture is black; check lamp, shutter and exposure. Nothing moves",
                )
            )
        if self._frame_check.is_repeated:
            return
        axes = self._session.driver.axes
        self._images.append(grey(frame.pixels))
        self._commands.append(np.array([state.command[axis] for axis in axes]))
        self._measured.append(np.array([state.measured[axis] for axis in axes]))

    def _seen(self) -> SettledFrame:
        return SettledFrame(
            image=np.mean(self._images, axis=0, dtype=np.float32),
            command=np.mean(self._commands, axis=0),
            measured=np.mean(self._measured, axis=0),
        )

    def _refuse_if_broken(self, state: SessionState) -> None:
        if not self.permit.valid:
            raise MicroscopeError(message("engine", "the machine was stopped; it stays in place"))
        if state.connection is not Connection.CONNECTED or state.fault is not None:
            reason = state.fault or state.locked or message("engine", "it is not connected")
            raise MicroscopeError(
                message("engine", "the machine no longer moves: {reason}").fill(reason=reason)
            )
        if state.locked is not None:
            raise MicroscopeError(
                message("engine", "motion is locked: {locked}").fill(locked=state.locked)
            )


def _size(region: Region) -> str:
    return message("engine", "{width} × {height} px from {left}, {top}").fill(
        width=region.width, height=region.height, left=region.left, top=region.top
    )
