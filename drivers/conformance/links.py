"""Checks of a driver whose link is cut, or whose port accepts no more bytes."""

import threading
from collections.abc import Callable
from contextlib import suppress

from rotemina.drivers.conformance.bench import DriverBench
from rotemina.drivers.conformance.check import check
from rotemina.drivers.conformance.driver_under_test import STROKE_S, DriverUnderTest
from rotemina.drivers.conformance.findings import (
    CheckNotApplicable,
    RequirementNotMet,
    require_refusal,
    require_that,
    require_within,
)
from rotemina.drivers.contract import (
    ConnectionLostError,
    DeviceState,
    DriverError,
    StateError,
)

_LINK_HOOKS = ("cut_link", "restore_link")
_BLOCK_HOOKS = ("block_port", "unblock_port")
# A stop that does not block returns much sooner; one that blocks takes much longer.
_STOP_TIMEOUT_S = 2.0
# Host time within which the reads make the driver give up the link. No computer needs this long.
_READ_TIMEOUT_S = 60.0


def _cut_link(bench: DriverBench) -> None:
    assert bench.cut_link is not None, "a check runs only if its hooks are set"
    bench.cut_link()


def _restore_link(bench: DriverBench) -> None:
    assert bench.restore_link is not None, "a check runs only if its hooks are set"
    bench.restore_link()


def _lose_link(bench: DriverBench, subject: DriverUnderTest) -> None:
    _cut_link(bench)
    _read_until_lost(bench, subject, "the link was cut")


def _read_until_lost(bench: DriverBench, subject: DriverUnderTest, event: str) -> None:
    elapsed_s = 0.0
    while elapsed_s < bench.long_loss_s:
        subject.advance(subject.step_s)
        elapsed_s += subject.step_s
        try:
            subject.driver.read()
        except ConnectionLostError:
            return
    raise RequirementNotMet(
        f"reads still succeed {bench.long_loss_s:g} s after {event}; expected: ConnectionLostError"
    )


@check(hooks=_LINK_HOOKS)
def short_loss(bench: DriverBench) -> None:
    """A short loss is masked: no read raises, samples resume, and nothing begins to move.

    Once the driver knows that the device is silent, it refuses moves.
    """
    with bench.open_driver() as subject:
        driver, axis = subject.driver, subject.slowest_axis
        try:
            _cut_link(bench)
            subject.run(bench.short_loss_s)
            if driver.status().silent_s > 0.0:
                require_refusal(
                    "a move to a silent device",
                    lambda: driver.move_to({axis.name: axis.low}),
                    StateError,
                )
        finally:
            _restore_link(bench)
        subject.run(bench.short_loss_s + 0.2)
        silent_s = driver.status().silent_s
        require_that(silent_s == 0.0, f"the link is back, but silent for {silent_s:g} s", "0 s")
        subject.require_hold()


@check(hooks=_LINK_HOOKS)
def long_loss(bench: DriverBench) -> None:
    """After a long loss every read raises ConnectionLostError until the driver is closed."""
    with bench.open_driver() as subject:
        try:
            _lose_link(bench, subject)
        finally:
            _restore_link(bench)
        subject.advance(subject.step_s)
        require_refusal("a read after the link was lost", subject.driver.read, DriverError)


@check(hooks=_LINK_HOOKS)
def nothing_resumes(bench: DriverBench) -> None:
    """When a lost link is restored, nothing moves, and after reopening the device is at rest."""
    with bench.open_driver() as subject:
        driver, axis = subject.driver, subject.slowest_axis
        subject.move_to_far_end(axis)
        subject.run(STROKE_S)
        try:
            _lose_link(bench, subject)
        except RequirementNotMet as failure:
            raise CheckNotApplicable("it does not give up a lost link (long-loss)") from failure
        finally:
            _restore_link(bench)
        require_refusal(
            "a move after the link was lost",
            lambda: driver.move_to({axis.name: axis.low}),
            DriverError,
        )
        driver.close()
        driver.open()
        subject.run(0.1)
        state = subject.state
        is_at_rest = state in (DeviceState.IDLE, DeviceState.FAULT)
        require_that(is_at_rest, f"after reopening it is {state}", "at rest")
        subject.require_hold(0.5)


def _require_return(call_name: str, call: Callable[[], object], timeout_s: float) -> None:
    """Require that a call in another thread returns; raise its exception, if any."""
    errors: list[Exception] = []

    def run() -> None:
        try:
            call()
        except Exception as error:
            errors.append(error)

    thread = threading.Thread(target=run, name="caller of a check", daemon=True)
    thread.start()
    thread.join(timeout_s)
    require_that(
        not thread.is_alive(), f"{call_name} has not returned for {timeout_s:g} s", "at once"
    )
    if errors:
        raise errors[0]


@check(hooks=_BLOCK_HOOKS)
def blocked_port(bench: DriverBench) -> None:
    """If the port accepts no bytes, a stop returns at once, and reads soon fail.

    The reads raise ConnectionLostError. When the port accepts bytes again, the device can be opened
    and moved.
    """
    assert bench.block_port is not None, "a check runs only if its hooks are set"
    assert bench.unblock_port is not None, "a check runs only if its hooks are set"
    with bench.open_driver() as subject:
        driver, axis = subject.driver, subject.slowest_axis
        subject.move_to_far_end(axis)
        subject.run(STROKE_S)
        bench.block_port()
        try:
            _require_return("a stop", driver.stop, _STOP_TIMEOUT_S)
            _require_return(
                "a read",
                lambda: _read_until_lost(bench, subject, "the port was blocked"),
                _READ_TIMEOUT_S,
            )
        finally:
            bench.unblock_port()
        # Closing a port that was lost may fail.
        with suppress(DriverError):
            driver.close()
        driver.open()
        subject.make_ready()
        target = subject.move_by(
            axis, axis.compute_stroke(float(subject.read_command()[axis.index]))
        )
        subject.run_until_idle()
        actual = float(subject.read_command()[axis.index])
        require_within(
            f"after reopening, axis {axis.name} ends at",
            actual,
            target,
            axis.half_step,
            axis.unit,
        )
