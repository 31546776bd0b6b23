"""Check of a source of input devices against the contract.

The name of each check function is the name of the check in the output, and its docstring is the
printed requirement.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from math import isnan

from rotemina.app.plugin_kit.findings import run_plugin_checks
from rotemina.drivers.conformance import CheckNotApplicable, DriverCheckResult, require_that
from rotemina.drivers.contract import Clock, DriverError, StateError, VirtualClock
from rotemina.drivers.inputs import (
    InputDevice,
    InputIdentity,
    InputReading,
    InputSource,
)

_READ_COUNT, _READ_PAUSE_S = 50, 0.02


@dataclass(frozen=True, slots=True)
class _InputBench:
    source: InputSource
    clock: Clock
    wait: Callable[[float], None]

    @contextmanager
    def open_device(self) -> Iterator[InputDevice]:
        """Open the first connected device, and close it afterwards."""
        identities = self.source.devices()
        if not identities:
            raise CheckNotApplicable(self.source.problem or "nothing is plugged in")
        device = self.source.open(identities[0])
        try:
            yield device
        finally:
            device.close()


def check_inputs(
    source: type[InputSource],
    *,
    clock: Clock | None = None,
    wait: Callable[[float], None] | None = None,
) -> tuple[DriverCheckResult, ...]:
    """Check a source and the first of its devices.

    Parameters
    ----------
    source : type of InputSource
    clock, wait : callable, optional
        ``clock`` returns the host's time, s, and ``wait`` waits for a number of seconds. Give both
        or neither; by default a virtual clock is used.
    """

    @contextmanager
    def open_bench() -> Iterator[_InputBench]:
        virtual_clock = VirtualClock(1234.5)
        source_clock = clock or virtual_clock
        yield _InputBench(source(clock=source_clock), source_clock, wait or virtual_clock.advance)

    return run_plugin_checks((listed, read, closed, strange), open_bench)


def listed(bench: _InputBench) -> None:
    """List the connected devices, each with a unique key."""
    identities = bench.source.devices()
    invalid_identities = [
        identity for identity in identities if not isinstance(identity, InputIdentity)
    ]
    require_that(
        not invalid_identities, f"devices() answered {invalid_identities}", "each an InputIdentity"
    )
    keys = [identity.key for identity in identities]
    require_that(len(set(keys)) == len(keys), f"keys {keys}", "no key twice")


def read(bench: _InputBench) -> None:
    """Return readings in order of time, one value per named axis and button, axes from −1 to 1."""
    start_s = previous_s = bench.clock()
    with bench.open_device() as device:
        for _ in range(_READ_COUNT):
            bench.wait(_READ_PAUSE_S)
            for reading in device.read():
                _check_reading(device, reading)
                time_s = reading.host_time_s
                now_s = bench.clock()
                require_that(
                    previous_s - 1e-9 <= time_s <= now_s + 1e-9,
                    f"a reading of {time_s - start_s:.3f} s after {previous_s - start_s:.3f} s, "
                    f"{now_s - start_s:.3f} s after opening",
                    "times of the host's clock that never decrease and are not in the future",
                )
                previous_s = time_s


def closed(bench: _InputBench) -> None:
    """Close twice without an error, and raise StateError if read afterwards."""
    with bench.open_device() as device:
        device.close()
        device.close()
        try:
            device.read()
        except StateError:
            return
        require_that(False, "it could be read when it was closed", "StateError")


def strange(bench: _InputBench) -> None:
    """Refuse a device that is not connected by InputLostError or another DriverError."""
    try:
        bench.source.open(InputIdentity("nobody:0", "nobody's device", "nobody"))
    except DriverError:
        return
    require_that(False, "it opened a device that it never listed", "InputLostError")


def _check_reading(device: InputDevice, reading: InputReading) -> None:
    for kind, names, values in (
        ("axes", device.axes, reading.axes),
        ("buttons", device.buttons, reading.buttons),
    ):
        description = f"{len(values)} {kind} in a reading"
        require_that(
            len(names) == len(values), description, f"{len(names)}, as in {kind} of the device"
        )
    out_of_range = [
        deflection
        for deflection in reading.axes
        if not isnan(deflection) and not -1.0 <= deflection <= 1.0
    ]
    require_that(
        not out_of_range,
        f"deflections {out_of_range}",
        "−1 to 1, or NaN where the deflection is unknown",
    )
