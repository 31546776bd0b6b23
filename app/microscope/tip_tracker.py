"""Tracking of the tip in the newest picture; pictures are skipped, never queued."""

import threading
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np

from rotemina.app.cameras import FeedState, FeedView
from rotemina.app.microscope.status import TipState
from rotemina.drivers.cameras import CameraFrame
from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message
from rotemina.sim.vision import (
    BackgroundImage,
    BodyPart,
    Image,
    Pipette,
    TipTrack,
    begin_track,
    find_tip,
    find_tip_in_any_direction,
    follow_tip,
    learn_body,
    to_grey,
)

BACKGROUND_PERIOD_S = 0.5
# Number of pictures after which the appearance of the pipette's body is known well enough.
MIN_LEARNT_PICTURES = 30
_SEARCH_PERIOD_S = 0.5
_MAX_PATH_POINTS, _MIN_PATH_STEP_PX = 2000, 1.0
# Half the side of the square that is searched around a clicked pixel.
_SEARCH_RADIUS_PX = 150.0
# Half the side of the square around the goal of a move in which the background is needed.
_LANDING_RADIUS_PX = 100.0
_TRUSTED_STATES = (FeedState.LIVE, FeedState.WAITING)


class TipContact(StrEnum):
    """Whether the tip presses on a cell."""

    NO = "no"
    # The tip is above the cell and will press on it next.
    SOON = "soon"
    YES = "yes"


@dataclass(frozen=True, slots=True, eq=False)
class TrackingResult:
    """The result of tracking in one picture.

    Attributes
    ----------
    state : TipState
    track : TipTrack or None
        None until the tip is found.
    frame : CameraFrame or None
        The latest picture that was searched.
    reason : str
        Why the tip was not found, or is lost.
    processed, skipped : int
        Numbers of pictures since tracking was switched on.
    lost_since_s : float or None
        Host time of the first picture without the tip; None while the tip is tracked.
    has_background : bool
        Whether the background beneath the tip was removed.
    """

    state: TipState = TipState.OFF
    track: TipTrack | None = None
    frame: CameraFrame | None = None
    reason: str = ""
    processed: int = 0
    skipped: int = 0
    lost_since_s: float | None = None
    has_background: bool = False


class TipTracker:
    """Tracks the tip. One thread calls :meth:`step`; any thread may use all other members.

    Parameters
    ----------
    read_feed : callable
        Returns the state and the newest picture of the camera.
    make_pipette : callable
        Returns the pipette, and whether its direction is known. Raises InputError if the shape of
        the pipette is unknown.
    predict_pixel : callable
        Returns the tip's pixel (2,) predicted from command and calibration, or None.
    read_contact : callable
        Returns whether the tip presses on a cell.
    on_result : callable
        Called with the result of every picture.
    """

    def __init__(
        self,
        read_feed: Callable[[], FeedView],
        make_pipette: Callable[[], tuple[Pipette, bool]],
        predict_pixel: Callable[[], FloatArray | None],
        read_contact: Callable[[], TipContact],
        on_result: Callable[[TrackingResult], None] = lambda _: None,
    ) -> None:
        self._read_feed, self._make_pipette, self._predict_pixel = (
            read_feed,
            make_pipette,
            predict_pixel,
        )
        self._read_contact, self._on_result = read_contact, on_result
        # Guards the requests; never held during a wait.
        self._lock = threading.Lock()
        self._is_on = False
        self._must_restart = False
        self._search_centre: FloatArray | None = None
        self._is_background_requested = False
        # Replaced by a new object for each picture, only by the thread that calls :meth:`step`.
        self._result = TrackingResult()
        self._background: BackgroundImage | None = None
        self._last_background_s = 0.0
        self._view_settings: object = None
        self._last_search_s = -np.inf
        self._last_prediction: FloatArray | None = None
        self._path: deque[tuple[float, float]] = deque(maxlen=_MAX_PATH_POINTS)

    @property
    def result(self) -> TrackingResult:
        """The result of the newest picture."""
        return self._result

    @property
    def tip(self) -> TipTrack | None:
        """The tip, while it is tracked."""
        result = self._result
        return result.track if result.state is TipState.TRACKED else None

    @property
    def path(self) -> FloatArray | None:
        """Path of the tip (n, 2), px; None while it has fewer than two points."""
        path = tuple(self._path)
        return np.array(path) if len(path) > 1 else None

    def get_background(self, pixel: FloatArray) -> Image | None:
        """Return the picture without the tip, or None if it is unknown around ``pixel`` (2,)."""
        background = self._background
        if background is None or not background.is_known(
            pixel - _LANDING_RADIUS_PX, pixel + _LANDING_RADIUS_PX
        ):
            return None
        return background.image

    def switch(self, on: bool, search_px: FloatArray | None = None) -> None:
        """Turn tracking on or off.

        Tracking begins with a search around the pixel ``near`` (2,), or in the whole picture if
        that is None.
        """
        with self._lock:
            self._is_on, self._must_restart = on, True
            self._search_centre = (
                None if search_px is None else np.asarray(search_px, dtype=np.float64)
            )

    def take_background(self) -> None:
        """Replace the background with the current picture, except under the pipette."""
        with self._lock:
            self._is_background_requested = True

    def step(self) -> None:
        """Process the newest picture, unless it has been processed before."""
        with self._lock:
            is_on, must_restart, self._must_restart = self._is_on, self._must_restart, False
        if must_restart:
            self._path.clear()
            self._last_search_s, self._last_prediction = -np.inf, None
            self._result = TrackingResult(TipState.SEARCHED if is_on else TipState.OFF)
        view, previous = self._read_feed(), self._result
        frame = view.frame
        if not is_on or frame is None:
            return
        if frame is previous.frame:
            if view.state not in _TRUSTED_STATES and previous.state is TipState.TRACKED:
                self._result = self._mark_lost(previous, _describe_camera_problem(view))
            return
        self._drop_outdated(frame)
        skipped = previous.skipped
        if previous.frame is not None:
            skipped += max(frame.number - previous.frame.number - 1, 0)
        result = replace(
            previous,
            frame=frame,
            skipped=skipped,
            processed=previous.processed + 1,
            has_background=False,
        )
        if view.state not in _TRUSTED_STATES:
            self._result = self._mark_lost(result, _describe_camera_problem(view))
        elif result.track is None:
            self._result = self._search_tip(result, frame)
        else:
            self._result = self._follow_tip(result, result.track, frame)
        self._extend_path()
        self._update_background(frame)
        self._on_result(self._result)

    def _drop_outdated(self, frame: CameraFrame) -> None:
        """Discard the background if the view has changed, and the tip if the region has changed."""
        view_settings = (
            frame.region,
            frame.exposure_s,
            frame.metadata.get("focus_m"),
            frame.is_colour,
        )
        if view_settings != self._view_settings:
            self._view_settings, self._background = view_settings, None
        if self._result.frame is not None and self._result.frame.region != frame.region:
            self._result = replace(self._result, track=None, state=TipState.SEARCHED)

    def _search_tip(self, result: TrackingResult, frame: CameraFrame) -> TrackingResult:
        if frame.host_time_s - self._last_search_s < _SEARCH_PERIOD_S:
            return result
        self._last_search_s = frame.host_time_s
        try:
            pipette, is_direction_known = self._make_pipette()
            image, corner = self._cut_search_area(to_grey(frame.pixels))
            search = find_tip if is_direction_known else find_tip_in_any_direction
            fit = search(image, pipette)
            aligned_pipette = replace(pipette, direction=fit.direction)
            track = begin_track(image, aligned_pipette, turning=False)
        except InputError as error:
            return replace(result, reason=str(error))
        self._last_prediction = self._predict_pixel()
        track = replace(track, pixel=track.pixel + corner)
        return replace(result, state=TipState.TRACKED, track=track, reason="", lost_since_s=None)

    def _cut_search_area(self, image: Image) -> tuple[Image, FloatArray]:
        """Return the part of the picture to search, and the pixel (2,) of its upper left corner."""
        centre = self._search_centre
        if centre is None:
            return image, np.zeros(2)
        low = np.maximum(np.rint(centre - _SEARCH_RADIUS_PX).astype(int), 0)
        high = np.minimum(np.rint(centre + _SEARCH_RADIUS_PX).astype(int), image.shape[::-1])
        return np.ascontiguousarray(image[low[1] : high[1], low[0] : high[0]]), low.astype(float)

    def _follow_tip(
        self, result: TrackingResult, track: TipTrack, frame: CameraFrame
    ) -> TrackingResult:
        image = frame.pixels if not frame.is_colour else to_grey(frame.pixels)
        prediction, last_prediction = self._predict_pixel(), self._last_prediction
        displacement = (
            None if prediction is None or last_prediction is None else prediction - last_prediction
        )
        self._last_prediction = prediction
        contact = self._read_contact()
        track = replace(track, dimple=contact is TipContact.YES)
        background = self._find_usable_background(track, contact)
        if (
            contact is TipContact.SOON
            and track.learnt_frames < MIN_LEARNT_PICTURES
            and not track.lost
        ):
            track = learn_body(track, image, background=background)
        else:
            if contact is TipContact.NO and track.learnt_frames:
                track = replace(track, learnt_frames=0, offset=np.zeros(2))
            track = follow_tip(track, image, background=background, moved=displacement)
        if track.lost:
            return self._mark_lost(replace(result, track=track), track.reason)
        return replace(
            result,
            state=TipState.TRACKED,
            track=track,
            reason="",
            lost_since_s=None,
            has_background=background is not None,
        )

    def _find_usable_background(self, track: TipTrack, contact: TipContact) -> Image | None:
        """Return the background, or None if it is unknown in the region that needs it."""
        background, direction = self._background, track.pipette.direction
        if background is None:
            return None
        centre, half_side = track.pixel, _SEARCH_RADIUS_PX
        if contact is not TipContact.NO:
            body = BodyPart.of(track.pipette)
            centre = centre + body.ahead * np.array([np.cos(direction), np.sin(direction)])
            half_side = float(body.half)
        return (
            background.image
            if background.is_known(centre - half_side, centre + half_side)
            else None
        )

    def _mark_lost(self, result: TrackingResult, reason: str) -> TrackingResult:
        assert result.frame is not None
        since_s = result.lost_since_s
        since_s = result.frame.host_time_s if since_s is None else since_s
        state = TipState.SEARCHED if result.track is None else TipState.LOST
        return replace(result, state=state, reason=reason, lost_since_s=since_s)

    def _extend_path(self) -> None:
        track = self._result.track
        if track is None or self._result.state is not TipState.TRACKED:
            return
        pixel = float(track.pixel[0]), float(track.pixel[1])
        if (
            not self._path
            or float(np.hypot(*np.subtract(pixel, self._path[-1]))) > _MIN_PATH_STEP_PX
        ):
            self._path.append(pixel)

    def _update_background(self, frame: CameraFrame) -> None:
        """Add the picture to the background when due, unless the tip presses on a cell."""
        with self._lock:
            is_requested = self._is_background_requested
        track, is_due = (
            self._result.track,
            frame.host_time_s - self._last_background_s >= BACKGROUND_PERIOD_S,
        )
        if self._result.state is not TipState.TRACKED or track is None:
            return
        if self._read_contact() is TipContact.YES or not (is_requested or is_due):
            return
        with self._lock:
            self._is_background_requested = False
        image = frame.pixels if not frame.is_colour else to_grey(frame.pixels)
        if is_requested or self._background is None:
            rows, columns = image.shape[:2]
            self._background = BackgroundImage.empty((rows, columns))
        depth_m = track.depth.distance
        self._background = self._background.with_picture(image, track.pipette, track.pixel, depth_m)
        self._last_background_s = frame.host_time_s


def _describe_camera_problem(view: FeedView) -> str:
    return message("engine", "the camera is {state}: {reason}").fill(
        state=view.state, reason=view.reason
    )
