"""The test bench of a driver: it makes the driver and advances its time."""

import signal
import sys
import threading
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass

from rotemina.drivers.clock import VirtualClock
from rotemina.drivers.conformance.driver_under_test import Subject
from rotemina.drivers.driver import Driver
from rotemina.sim.robot.model import Robot


@dataclass(frozen=True, kw_only=True)
class Bench:
    """How checks get hold of a driver, and of what surrounds it.

    Attributes
    ----------
    make : callable
        Returns a new driver with settings beside those that the bench has by itself; opens nothing.
    advance : callable
        Lets so many seconds pass on the driver's clock: real ones, or those of a clock set by hand
        together with whatever stands at the other end of an in-memory line.
    cut_link, restore_link : callable, optional
        Pull the cable and put it back. Without them nothing is checked about lost links.
    block_port, unblock_port : callable, optional
        Let the device's end of the line take no more bytes, and take them again, while what the
        device says still arrives. Without them nothing is checked about blocked ports.
    misreport : callable, optional
        Let the next report of the open device carry a position that cannot be true.
    delay_line : callable, optional
        Let each byte from now on take so many seconds, each way.
    cause_fault : callable, optional
        Bring about a fault of the open device that can be cleared at once.
    touched : callable, optional
        Whether anything has reached the device since the bench was made.
    short_loss_s, long_loss_s : float
        A loss of the link that the driver must mask, and one after which it must have given up; so
        must it after as long a time with a blocked port.
    """

    make: Callable[[Mapping[str, object]], Driver]
    advance: Callable[[float], None]
    cut_link: Callable[[], None] | None = None
    restore_link: Callable[[], None] | None = None
    block_port: Callable[[], None] | None = None
    unblock_port: Callable[[], None] | None = None
    misreport: Callable[[], None] | None = None
    delay_line: Callable[[float], None] | None = None
    cause_fault: Callable[[Driver], None] | None = None
    touched: Callable[[], bool] | None = None
    short_loss_s: float = 0.1
    long_loss_s: float = 5.0

    @contextmanager
    def opened(self, *, to_move: bool = True) -> Iterator[Subject]:
        """Make a driver, open it and, in order ``to_move`` it, home it if it has to be.

        Afterwards it is stopped and closed; that is also what a Ctrl-C does, and a signal to end.

        Raises
        ------
        Inapplicable
            If the position is unknown and the device cannot home, so that it cannot be moved.
        """
        driver = self.make({})
        with _ended_by_signals():
            try:
                driver.open()
                subject = Subject(driver, self.advance)
                if to_move:
                    subject.make_ready()
                yield subject
            finally:
                # What closing raises is the matter of the checks of closing, not of every check.
                postponed: list[int] = []
                with _postponed(postponed), suppress(Exception):
                    driver.stop()
                with suppress(Exception):
                    driver.close()
                # One that has ended the check already is enough.
                if postponed and sys.exc_info()[0] is None:
                    signal.raise_signal(signal.Signals(postponed[-1]))


def _to_end() -> tuple[signal.Signals, ...]:
    """Return the signals by which this thread is told to end; Python tells the main one alone."""
    if threading.current_thread() is not threading.main_thread():
        return ()
    return tuple(signal.Signals[name] for name in _ENDS if name in signal.Signals.__members__)


@contextmanager
def _handled(handler: Callable[..., object], numbers: Iterable[signal.Signals]) -> Iterator[None]:
    before = {number: signal.signal(number, handler) for number in numbers}
    try:
        yield
    finally:
        for number, other in before.items():
            signal.signal(number, other)


@contextmanager
def _ended_by_signals() -> Iterator[None]:
    """End as Ctrl-C does, wherever a signal would end the program without stopping anything."""
    ends = [one for one in _to_end() if signal.getsignal(one) is signal.SIG_DFL]
    with _handled(signal.default_int_handler, ends):
        yield


@contextmanager
def _postponed(received: list[int]) -> Iterator[None]:
    """Let no Ctrl-C come between the first one and the stop; note those that came."""
    known = [number for number in _to_end() if signal.getsignal(number) is not None]
    with _handled(lambda number, _: received.append(number), known):
        yield


_ENDS = ("SIGINT", "SIGTERM", "SIGHUP")


def bench_of(
    driver: type[Driver], robot: Robot, settings: Mapping[str, object] | None = None
) -> Bench:
    """Return a bench for an installed driver: on a clock set by hand if it can live on one."""
    own = dict(settings or {})
    if not driver.virtual_time:
        return Bench(make=lambda given: driver(robot, {**own, **given}), advance=time.sleep)
    clock = VirtualClock(1234.5)
    return Bench(
        make=lambda given: driver(robot, {**own, **given}, clock=clock), advance=clock.advance
    )
