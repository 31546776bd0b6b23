"""Tracks the tip in the newest picture, skipping pictures rather than building a backlog."""

import threading
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np

from rotemina.app.cameras.feed import FeedState, FeedView
from rotemina.app.microscope.status import TipState
from rotemina.drivers.cameras.frame import Frame
from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message
from rotemina.sim.vision.background import Ground
from rotemina.sim.vision.body_fit import BodyPart
from rotemina.sim.vision.image import Image, grey
from rotemina.sim.vision.pipette import Pipette
from rotemina.sim.vision.tip import find_body, find_tip
from rotemina.sim.vision.tracking import TipTrack, begin_track, follow, learn

GROUND_S = 0.5  # between two pictures that a background is made of
LEARNT = 30  # pictures from which a body is known well enough
_AGAIN_S = 0.5  # between two searches of the whole picture
_PATH, _PATH_STEP_PX = 2000, 1.0
_NEAR_PX = 150.0  # about a click that says where the tip is
_LANDED_PX = 100.0  # about where a tip is looked for after a move
_TRUSTED = (FeedState.LIVE, FeedState.WAITING)


class Pressing(StrEnum):
    """Whether the tip presses on a cell."""

    NO = "no"
    SOON = "soon"  # it stands above the cell, and is going to
    YES = "yes"


@dataclass(frozen=True, slots=True, eq=False)
class Tracked:
    """The tracking result of a picture.

    Attributes
    ----------
    state : TipState
    track : TipTrack or None
        None before it was found.
    frame : Frame or None
        In which it was looked for last.
    reason : str
        Why it is not found, or lost.
    processed, skipped : int
        Pictures since tracking was switched on.
    lost_since_s : float or None
        Host time of the first picture that did not show it.
    ground : bool
        Whether what lies beneath it was taken off.
    """

    state: TipState = TipState.OFF
    track: TipTrack | None = None
    frame: Frame | None = None
    reason: str = ""
    processed: int = 0
    skipped: int = 0
    lost_since_s: float | None = None
    ground: bool = False


class TipTracker:
    """Tracks when switched on; one thread steps, any may ask.

    Parameters
    ----------
    view : callable
        Return how the camera is doing, with its newest picture.
    shape : callable
        Return the pipette and whether its direction is known; raises InputError where it cannot.
    expected : callable
        Return where the tip should be by commands and calibration, px, or None.
    pressing : callable
        Return whether the tip presses on a cell.
    told : callable
        Gets every result that a picture gave.
    """

    def __init__(
        self,
        view: Callable[[], FeedView],
        shape: Callable[[], tuple[Pipette, bool]],
        expected: Callable[[], FloatArray | None],
        pressing: Callable[[], Pressing],
        told: Callable[[Tracked], None] = lambda _: None,
    ) -> None:
        self._view, self._shape, self._expected = view, shape, expected
        self._pressing, self._told = pressing, told
        self._lock = threading.Lock()  # guards wishes; never held while anybody waits
        self._on = False
        self._anew = False
        self._near: FloatArray | None = None
        self._ground_wanted = False
        self._tracked = Tracked()  # exchanged as a whole, by the thread alone
        self._ground: Ground | None = None
        self._ground_s = 0.0
        self._about: object = None
        self._searched_s = -np.inf
        self._was: FloatArray | None = None
        self._path: deque[tuple[float, float]] = deque(maxlen=_PATH)

    # --- any thread -------------------------------------------------------------------------------

    @property
    def tracked(self) -> Tracked:
        """The result of the newest picture."""
        return self._tracked

    @property
    def tip(self) -> TipTrack | None:
        """The tip, while it is tracked."""
        tracked = self._tracked
        return tracked.track if tracked.state is TipState.TRACKED else None

    @property
    def path(self) -> FloatArray | None:
        """Where the tip went (n, 2), px."""
        path = tuple(self._path)
        return np.array(path) if len(path) > 1 else None

    def ground_about(self, pixel: FloatArray) -> Image | None:
        """Return the picture without the tip, if it is known about ``pixel`` (2,)."""
        ground = self._ground
        if ground is None or not ground.known(pixel - _LANDED_PX, pixel + _LANDED_PX):
            return None
        return ground.image

    def switch(self, on: bool, near: FloatArray | None = None) -> None:
        """Begin to look for the tip, in the whole picture or about ``near`` (2,), px; or end."""
        with self._lock:
            self._on, self._anew = on, True
            self._near = None if near is None else np.asarray(near, dtype=np.float64)

    def take_ground(self) -> None:
        """Replace the background by the present picture, except under the pipette."""
        with self._lock:
            self._ground_wanted = True

    # --- the thread that steps --------------------------------------------------------------------

    def step(self) -> None:
        """Process the newest picture, unless it was already processed."""
        with self._lock:
            on, anew, self._anew = self._on, self._anew, False
        if anew:
            self._path.clear()
            self._searched_s, self._was = -np.inf, None
            self._tracked = Tracked(TipState.SEARCHED if on else TipState.OFF)
        view, before = self._view(), self._tracked
        frame = view.frame
        if not on or frame is None:
            return
        if frame is before.frame:
            if view.state not in _TRUSTED and before.state is TipState.TRACKED:
                self._tracked = self._lost(before, _untrusted(view))
            return
        self._mind(frame)
        passed = before.skipped
        if before.frame is not None:
            passed += max(frame.number - before.frame.number - 1, 0)
        state = replace(
            before, frame=frame, skipped=passed, processed=before.processed + 1, ground=False
        )
        if view.state not in _TRUSTED:
            self._tracked = self._lost(state, _untrusted(view))
        elif state.track is None:
            self._tracked = self._found(state, frame)
        else:
            self._tracked = self._followed(state, state.track, frame)
        self._keep_path()
        self._make_ground(frame)
        self._told(self._tracked)

    def _mind(self, frame: Frame) -> None:
        """Forget the background of another view, and the tip in a picture of another size."""
        about = (frame.region, frame.exposure_s, frame.metadata.get("focus_m"), frame.colour)
        if about != self._about:
            self._about, self._ground = about, None
        if self._tracked.frame is not None and self._tracked.frame.region != frame.region:
            self._tracked = replace(self._tracked, track=None, state=TipState.SEARCHED)

    def _found(self, state: Tracked, frame: Frame) -> Tracked:
        """Look for it in the whole picture, or about where someone pointed."""
        if frame.host_time_s - self._searched_s < _AGAIN_S:
            return state
        self._searched_s = frame.host_time_s
        try:
            pipette, known = self._shape()
            image, low = self._part(grey(frame.pixels))
            finding = find_tip if known else find_body
            fit = finding(image, pipette)
            aimed = replace(pipette, direction=fit.direction)
            track = begin_track(image, aimed, turning=False)
        except InputError as error:
            return replace(state, reason=str(error))
        self._was = self._expected()
        track = replace(track, pixel=track.pixel + low)
        return replace(state, state=TipState.TRACKED, track=track, reason="", lost_since_s=None)

    def _part(self, image: Image) -> tuple[Image, FloatArray]:
        near = self._near
        if near is None:
            return image, np.zeros(2)
        low = np.maximum(np.rint(near - _NEAR_PX).astype(int), 0)
        high = np.minimum(np.rint(near + _NEAR_PX).astype(int), image.shape[::-1])
        return np.ascontiguousarray(image[low[1] : high[1], low[0] : high[0]]), low.astype(float)

    def _followed(self, state: Tracked, track: TipTrack, frame: Frame) -> Tracked:
        image = frame.pixels if not frame.colour else grey(frame.pixels)
        expected, was = self._expected(), self._was
        moved = None if expected is None or was is None else expected - was
        self._was = expected
        pressing = self._pressing()
        track = replace(track, dimple=pressing is Pressing.YES)
        ground = self._usable(track, pressing)
        if pressing is Pressing.SOON and track.learnt < LEARNT and not track.lost:
            track = learn(track, image, background=ground)
        else:
            if pressing is Pressing.NO and track.learnt:
                track = replace(track, learnt=0, offset=np.zeros(2))
            track = follow(track, image, background=ground, moved=moved)
        if track.lost:
            return self._lost(replace(state, track=track), track.reason)
        return replace(
            state,
            state=TipState.TRACKED,
            track=track,
            reason="",
            lost_since_s=None,
            ground=ground is not None,
        )

    def _usable(self, track: TipTrack, pressing: Pressing) -> Image | None:
        """Return the background, if it is known wherever it is going to be divided by."""
        ground, way = self._ground, track.pipette.direction
        if ground is None:
            return None
        middle, half = track.pixel, _NEAR_PX
        if pressing is not Pressing.NO:
            body = BodyPart.of(track.pipette)
            middle = middle + body.ahead * np.array([np.cos(way), np.sin(way)])
            half = float(body.half)
        return ground.image if ground.known(middle - half, middle + half) else None

    def _lost(self, state: Tracked, reason: str) -> Tracked:
        assert state.frame is not None
        since_s = state.lost_since_s
        since_s = state.frame.host_time_s if since_s is None else since_s
        kind = TipState.SEARCHED if state.track is None else TipState.LOST
        return replace(state, state=kind, reason=reason, lost_since_s=since_s)

    def _keep_path(self) -> None:
        track = self._tracked.track
        if track is None or self._tracked.state is not TipState.TRACKED:
            return
        here = float(track.pixel[0]), float(track.pixel[1])
        if not self._path or float(np.hypot(*np.subtract(here, self._path[-1]))) > _PATH_STEP_PX:
            self._path.append(here)

    def _make_ground(self, frame: Frame) -> None:
        """Add a picture to the background now and then, while the tip presses on nothing."""
        with self._lock:
            wanted = self._ground_wanted
        track, due = self._tracked.track, frame.host_time_s - self._ground_s >= GROUND_S
        if self._tracked.state is not TipState.TRACKED or track is None:
            return
        if self._pressing() is Pressing.YES or not (wanted or due):
            return
        with self._lock:
            self._ground_wanted = False
        image = frame.pixels if not frame.colour else grey(frame.pixels)
        if wanted or self._ground is None:
            rows, columns = image.shape[:2]
            self._ground = Ground.empty((rows, columns))
        away = track.depth.distance
        self._ground = self._ground.seen(image, track.pipette, track.pixel, away)
        self._ground_s = frame.host_time_s


def _untrusted(view: FeedView) -> str:
    return message("engine", "the camera is {state}: {reason}").fill(
        state=view.state, reason=view.reason
    )
