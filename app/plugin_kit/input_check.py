"""Check of an input-device source: whether it keeps the contract."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from math import isnan

from rotemina.app.plugin_kit.findings import results
from rotemina.drivers.clock import Clock, VirtualClock
from rotemina.drivers.conformance.check import Result
from rotemina.drivers.conformance.findings import Inapplicable, demand
from rotemina.drivers.errors import DriverError, StateError
from rotemina.drivers.inputs.device import InputDevice, InputIdentity, InputReading, InputSource

_READS, _PAUSE_S = 50, 0.02


@dataclass(frozen=True, slots=True)
class _Bench:
    """A source of its own, and how time passes for it."""

    source: InputSource
    clock: Clock
    wait: Callable[[float], None]

    @contextmanager
    def opened(self) -> Iterator[InputDevice]:
        """Open the first device that is plugged in, and close it afterwards."""
        there = self.source.devices()
        if not there:
            raise Inapplicable(self.source.problem or "nothing is plugged in")
        device = self.source.open(there[0])
        try:
            yield device
        finally:
            device.close()


def check_inputs(
    source: type[InputSource],
    *,
    clock: Clock | None = None,
    wait: Callable[[float], None] | None = None,
) -> tuple[Result, ...]:
    """Check a source and the first of its devices, on a clock set by hand or on one that is given.

    Parameters
    ----------
    source : type of InputSource
    clock, wait : callable, optional
        The host's time, s, and what lets so many seconds of it pass; both or none.
    """

    @contextmanager
    def bench() -> Iterator[_Bench]:
        by_hand = VirtualClock(1234.5)
        own = clock or by_hand
        yield _Bench(source(clock=own), own, wait or by_hand.advance)

    return results((listed, read, closed, strange), bench)


def listed(bench: _Bench) -> None:
    """Say what is plugged in, each device with a key of its own."""
    there = bench.source.devices()
    wrong = [one for one in there if not isinstance(one, InputIdentity)]
    demand(not wrong, f"devices() answered {wrong}", "each an InputIdentity")
    keys = [one.key for one in there]
    demand(len(set(keys)) == len(keys), f"keys {keys}", "no key twice")


def read(bench: _Bench) -> None:
    """Hand out readings in the order of time, as long as the names and within −1 to 1."""
    began_s = before_s = bench.clock()
    with bench.opened() as device:
        for _ in range(_READS):
            bench.wait(_PAUSE_S)
            for reading in device.read():
                _judge(device, reading)
                time_s = reading.host_time_s
                now_s = bench.clock()
                demand(
                    before_s - 1e-9 <= time_s <= now_s + 1e-9,
                    f"a reading of {time_s - began_s:.3f} s after {before_s - began_s:.3f} s, "
                    f"{now_s - began_s:.3f} s after opening",
                    "times of the host's clock that never go back, none to come",
                )
                before_s = time_s


def closed(bench: _Bench) -> None:
    """Close twice without harm, and refuse to be read afterwards by StateError."""
    with bench.opened() as device:
        device.close()
        device.close()
        try:
            device.read()
        except StateError:
            return
        demand(False, "it could be read when it was closed", "StateError")


def strange(bench: _Bench) -> None:
    """Refuse a device that is not plugged in by InputLostError or another DriverError."""
    try:
        bench.source.open(InputIdentity("nobody:0", "nobody's device", "nobody"))
    except DriverError:
        return
    demand(False, "it opened a device that it never listed", "InputLostError")


def _judge(device: InputDevice, reading: InputReading) -> None:
    for what, names, values in (
        ("axes", device.axes, reading.axes),
        ("buttons", device.buttons, reading.buttons),
    ):
        seen = f"{len(values)} {what} in a reading"
        demand(len(names) == len(values), seen, f"{len(names)}, as in {what} of the device")
    beyond = [at for at in reading.axes if not isnan(at) and not -1.0 <= at <= 1.0]
    demand(not beyond, f"deflections {beyond}", "−1 to 1, or NaN where nothing is known")
