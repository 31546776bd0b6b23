"""Check of a camera source and its first camera against the contract.

The name of each check function is the name of the check in the output, and its docstring is the
printed requirement.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from rotemina.app.plugin_kit.findings import run_plugin_checks
from rotemina.drivers.cameras import (
    Camera,
    CameraFrame,
    CameraIdentity,
    CameraSettings,
    CameraSource,
    CameraTrigger,
)
from rotemina.drivers.conformance import (
    CheckNotApplicable,
    DriverCheckResult,
    RequirementNotMet,
    require_that,
)
from rotemina.drivers.contract import CameraLostError, Clock, StateError, VirtualClock

_MAX_GRABS, _GRAB_TIMEOUT_S = 20, 0.2
_PICTURE_COUNT = 3


@dataclass(frozen=True, slots=True)
class _CameraBench:
    source: CameraSource
    clock: Clock

    def make_camera(self) -> Camera:
        """Return the first camera, not yet open."""
        identities = self.source.devices()
        if not identities:
            raise CheckNotApplicable(self.source.problem or "there is no camera")
        return self.source.camera(identities[0])

    @contextmanager
    def open_camera(self) -> Iterator[Camera]:
        """Open the first camera, and close it afterwards."""
        camera = self.make_camera()
        camera.open()
        try:
            yield camera
        finally:
            camera.close()


def check_cameras(
    source: type[CameraSource],
    *,
    clock: Clock | None = None,
    wait: Callable[[float], None] | None = None,
) -> tuple[DriverCheckResult, ...]:
    """Check a source and the first of its cameras.

    Parameters
    ----------
    source : type of CameraSource
    clock, wait : callable, optional
        ``clock`` returns the host's time, s, and ``wait`` waits for a number of seconds. Give both
        or neither; by default a virtual clock is used.
    """

    @contextmanager
    def open_bench() -> Iterator[_CameraBench]:
        virtual_clock = VirtualClock(1234.5)
        source_clock = clock or virtual_clock
        yield _CameraBench(
            source(clock=source_clock, wait=wait or virtual_clock.advance), source_clock
        )

    return run_plugin_checks((listed, untouched, pictures, triggered, closed), open_bench)


def listed(bench: _CameraBench) -> None:
    """List the available cameras, each with a key of source, colon and address."""
    identities = bench.source.devices()
    invalid_identities = [
        identity for identity in identities if not isinstance(identity, CameraIdentity)
    ]
    require_that(
        not invalid_identities, f"devices() answered {invalid_identities}", "each a CameraIdentity"
    )
    keys = [identity.key for identity in identities]
    require_that(len(set(keys)) == len(keys), f"keys {keys}", "no key twice")
    invalid_keys = [
        identity.key
        for identity in identities
        if not identity.key.startswith(f"{identity.source}:")
    ]
    require_that(not invalid_keys, f"keys {invalid_keys}", "the source, a colon and the address")


def untouched(bench: _CameraBench) -> None:
    """Open nothing when a camera is made: it is closed, and a grab raises StateError."""
    camera = bench.make_camera()
    try:
        camera.grab(0.0)
    except StateError:
        return
    require_that(False, "a picture could be grabbed before the camera was opened", "StateError")


def pictures(bench: _CameraBench) -> None:
    """Take pictures of the described size, in order, with times of the host's clock."""
    with bench.open_camera() as camera:
        frames = [_grab_picture(camera) for _ in range(_PICTURE_COUNT)]
        times = [frame.host_time_s for frame in frames]
        require_that(times == sorted(times), f"times {times}", "in order")
        require_that(
            times[-1] <= bench.clock() + 1e-9, f"a time of {times[-1]:g} s", "no time in the future"
        )
        numbers = [frame.number for frame in frames]
        require_that(
            sorted(set(numbers)) == numbers, f"numbers {numbers}", "each greater than the last"
        )


def triggered(bench: _CameraBench) -> None:
    """With a software trigger, take a picture only when one is requested."""
    with bench.open_camera() as camera:
        if CameraTrigger.SOFTWARE not in camera.description.triggers:
            raise CheckNotApplicable("it has no software trigger")
        camera.configure(CameraSettings(trigger=CameraTrigger.SOFTWARE))
        require_that(camera.grab(0.0) is None, "a picture without a trigger", "none")
        camera.trigger()
        _grab_picture(camera)


def closed(bench: _CameraBench) -> None:
    """Close twice without an error, and open again."""
    with bench.open_camera() as camera:
        camera.close()
        camera.close()
        camera.open()
        _grab_picture(camera)


def _grab_picture(camera: Camera) -> CameraFrame:
    for _ in range(_MAX_GRABS):
        try:
            frame = camera.grab(_GRAB_TIMEOUT_S)
        except CameraLostError as error:
            # The original error of the failed reads tells the author of the plugin what went wrong.
            raise error.__cause__ or error from None
        if frame is not None:
            return frame
    total_wait_s = _MAX_GRABS * _GRAB_TIMEOUT_S
    raise RequirementNotMet(f"no picture in {total_wait_s:g} s; expected: one")
