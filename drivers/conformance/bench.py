"""Test bench for a driver: creates the driver, advances its time, and causes faults."""

import signal
import sys
import threading
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING

from rotemina.drivers.conformance.driver_under_test import DriverUnderTest
from rotemina.drivers.contract import Driver, VirtualClock
from rotemina.sim.compatibility import FormerMember, serve_former_names
from rotemina.sim.robot import Robot


@dataclass(frozen=True, kw_only=True)
class DriverBench:
    """A test bench that creates a driver and controls its surroundings.

    Attributes
    ----------
    make : callable
        Creates a driver from the settings of the bench and additional ones, without opening it.
    advance : callable
        Lets a number of seconds pass on the driver's clock. The clock is either real or virtual. A
        virtual clock also drives the device at the other end of an in-memory line.
    cut_link, restore_link : callable, optional
        Unplug the cable and plug it in again. Without them, lost links are not checked.
    block_port, unblock_port : callable, optional
        Make the device's end of the line stop accepting bytes, and accept them again. Messages
        from the device still arrive. Without these hooks, blocked ports are not checked.
    misreport : callable, optional
        Puts an impossible position into the next report of the open device.
    delay_line : callable, optional
        From now on, delays each byte by a number of seconds, in both directions.
    cause_fault : callable, optional
        Causes a fault in the open device that can be cleared immediately.
    was_device_contacted : callable, optional
        Returns whether anything has reached the device since the bench was created.
    short_loss_s, long_loss_s : float
        Duration of a link loss that the driver must mask, and of one after which it must raise. The
        second also applies to a blocked port.
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
    was_device_contacted: Callable[[], bool] | None = None
    short_loss_s: float = 0.1
    long_loss_s: float = 5.0

    @contextmanager
    def open_driver(self, *, to_move: bool = True) -> Iterator[DriverUnderTest]:
        """Create and open a driver; with ``to_move``, also home it if that is necessary.

        At the end the driver is stopped and closed, also after Ctrl-C or a termination signal.

        Raises
        ------
        CheckNotApplicable
            If the position is unknown and the device cannot home, so that it cannot be moved.
        """
        driver = self.make({})
        with _interrupt_on_signals():
            try:
                driver.open()
                subject = DriverUnderTest(driver, self.advance)
                if to_move:
                    subject.make_ready()
                yield subject
            finally:
                # Separate checks cover errors while closing.
                postponed: list[int] = []
                with _postpone_signals(postponed), suppress(Exception):
                    driver.stop()
                with suppress(Exception):
                    driver.close()
                # An exception that already propagates must not be replaced by a signal.
                if postponed and sys.exc_info()[0] is None:
                    signal.raise_signal(signal.Signals(postponed[-1]))

    # Former names, which work for one more release.
    opened = FormerMember("open_driver")


def _find_termination_signals() -> tuple[signal.Signals, ...]:
    """Return the signals that end the program, or none outside the main thread.

    Python delivers signals only to the main thread.
    """
    if threading.current_thread() is not threading.main_thread():
        return ()
    return tuple(
        signal.Signals[name] for name in _TERMINATION_SIGNALS if name in signal.Signals.__members__
    )


@contextmanager
def _handle_signals(
    handler: Callable[..., object], signals: Iterable[signal.Signals]
) -> Iterator[None]:
    original_handlers = {number: signal.signal(number, handler) for number in signals}
    try:
        yield
    finally:
        for number, handler_before in original_handlers.items():
            signal.signal(number, handler_before)


@contextmanager
def _interrupt_on_signals() -> Iterator[None]:
    """Raise KeyboardInterrupt for signals that would otherwise end the program without a stop."""
    unhandled = [
        number
        for number in _find_termination_signals()
        if signal.getsignal(number) is signal.SIG_DFL
    ]
    with _handle_signals(signal.default_int_handler, unhandled):
        yield


@contextmanager
def _postpone_signals(received: list[int]) -> Iterator[None]:
    """Collect signals in ``received`` instead of acting on them, so that the stop completes."""
    replaceable = [
        number for number in _find_termination_signals() if signal.getsignal(number) is not None
    ]
    with _handle_signals(lambda number, _: received.append(number), replaceable):
        yield


_TERMINATION_SIGNALS = ("SIGINT", "SIGTERM", "SIGHUP")


def make_bench(
    driver: type[Driver], robot: Robot, settings: Mapping[str, object] | None = None
) -> DriverBench:
    """Create a bench for an installed driver, with a virtual clock if the driver supports it."""
    bench_settings = dict(settings or {})
    if not driver.virtual_time:
        return DriverBench(
            make=lambda extra: driver(robot, {**bench_settings, **extra}), advance=time.sleep
        )
    # An arbitrary start time shows that device time does not depend on the host clock's origin.
    clock = VirtualClock(1234.5)
    return DriverBench(
        make=lambda extra: driver(robot, {**bench_settings, **extra}, clock=clock),
        advance=clock.advance,
    )


if not TYPE_CHECKING:
    __getattr__ = serve_former_names(
        __name__,
        Bench="DriverBench",
        bench_of="make_bench",
    )
