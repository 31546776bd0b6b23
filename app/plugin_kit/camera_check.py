"""Check of a camera source: whether it and its first camera keep the contract."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from rotemina.app.plugin_kit.findings import results
from rotemina.drivers.cameras.camera import Camera, CameraIdentity
from rotemina.drivers.cameras.errors import CameraLostError
from rotemina.drivers.cameras.frame import Frame
from rotemina.drivers.cameras.settings import CameraSettings, Trigger
from rotemina.drivers.cameras.source import CameraSource
from rotemina.drivers.clock import Clock, VirtualClock
from rotemina.drivers.conformance.check import Result
from rotemina.drivers.conformance.findings import Inapplicable, Unmet, demand
from rotemina.drivers.errors import StateError

_TRIES, _TIMEOUT_S = 20, 0.2
_PICTURES = 3


@dataclass(frozen=True, slots=True)
class _Bench:
    """A source of its own, and its clock."""

    source: CameraSource
    clock: Clock

    def camera(self) -> Camera:
        """Return the first camera, not yet open."""
        there = self.source.devices()
        if not there:
            raise Inapplicable(self.source.problem or "there is no camera")
        return self.source.camera(there[0])

    @contextmanager
    def opened(self) -> Iterator[Camera]:
        """Open the first camera, and close it afterwards."""
        camera = self.camera()
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
) -> tuple[Result, ...]:
    """Check a source and the first of its cameras, on a clock set by hand or on one that is given.

    Parameters
    ----------
    source : type of CameraSource
    clock, wait : callable, optional
        The host's time, s, and what lets so many seconds of it pass; both or none.
    """

    @contextmanager
    def bench() -> Iterator[_Bench]:
        by_hand = VirtualClock(1234.5)
        own = clock or by_hand
        yield _Bench(source(clock=own, wait=wait or by_hand.advance), own)

    return results((listed, untouched, pictures, triggered, closed), bench)


def listed(bench: _Bench) -> None:
    """Say which cameras are there, each with a key of source, colon and address."""
    there = bench.source.devices()
    wrong = [one for one in there if not isinstance(one, CameraIdentity)]
    demand(not wrong, f"devices() answered {wrong}", "each a CameraIdentity")
    keys = [one.key for one in there]
    demand(len(set(keys)) == len(keys), f"keys {keys}", "no key twice")
    odd = [one.key for one in there if not one.key.startswith(f"{one.source}:")]
    demand(not odd, f"keys {odd}", "the source, a colon and the address")


def untouched(bench: _Bench) -> None:
    """Open nothing when a camera is made: it is closed and refuses to be asked."""
    camera = bench.camera()
    try:
        camera.grab(0.0)
    except StateError:
        return
    demand(False, "it could be grabbed from before it was opened", "StateError")


def pictures(bench: _Bench) -> None:
    """Take pictures of the size that it says, in order, with times of the host's clock."""
    with bench.opened() as camera:
        frames = [_next(camera) for _ in range(_PICTURES)]
        times = [frame.host_time_s for frame in frames]
        demand(times == sorted(times), f"times {times}", "in order")
        demand(times[-1] <= bench.clock() + 1e-9, f"a time of {times[-1]:g} s", "no time to come")
        numbers = [frame.number for frame in frames]
        demand(sorted(set(numbers)) == numbers, f"numbers {numbers}", "each greater than the last")


def triggered(bench: _Bench) -> None:
    """With a software trigger take one picture when it is requested, and none unasked."""
    with bench.opened() as camera:
        if Trigger.SOFTWARE not in camera.description.triggers:
            raise Inapplicable("it has no software trigger")
        camera.configure(CameraSettings(trigger=Trigger.SOFTWARE))
        demand(camera.grab(0.0) is None, "a picture that nobody asked for", "none")
        camera.trigger()
        _next(camera)


def closed(bench: _Bench) -> None:
    """Close twice without harm, and open again."""
    with bench.opened() as camera:
        camera.close()
        camera.close()
        camera.open()
        _next(camera)


def _next(camera: Camera) -> Frame:
    """Return the next picture; the camera's base class has looked at its size."""
    for _ in range(_TRIES):
        try:
            frame = camera.grab(_TIMEOUT_S)
        except CameraLostError as error:
            # What failed at every read is what the author of the plugin needs to know.
            raise error.__cause__ or error from None
        if frame is not None:
            return frame
    waited_s = _TRIES * _TIMEOUT_S
    raise Unmet(f"no picture in {waited_s:g} s; expected: one")
