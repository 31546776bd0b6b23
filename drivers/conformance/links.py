"""Checks of a driver's behaviour when its link is cut, or takes no more bytes."""

import threading
from collections.abc import Callable
from contextlib import suppress

from rotemina.drivers.conformance.bench import Bench
from rotemina.drivers.conformance.check import check
from rotemina.drivers.conformance.driver_under_test import CATCH_S, Subject
from rotemina.drivers.conformance.findings import Inapplicable, Unmet, demand, refused, within
from rotemina.drivers.errors import ConnectionLostError, DriverError, StateError
from rotemina.drivers.samples import DeviceState

_HOOKS = ("cut_link", "restore_link")
_BLOCK_HOOKS = ("block_port", "unblock_port")
# Far longer than a stop takes that does not wait, far shorter than somebody waits for one.
_PATIENCE_S = 2.0
# For reads until the link is given up, in the time of the host: longer than any machine needs.
_READS_PATIENCE_S = 60.0


def _cut(bench: Bench) -> None:
    assert bench.cut_link is not None, "a check runs where its hooks are"
    bench.cut_link()


def _restore(bench: Bench) -> None:
    assert bench.restore_link is not None, "a check runs where its hooks are"
    bench.restore_link()


def _lose(bench: Bench, subject: Subject) -> None:
    """Cut the link and read on until the driver gives up."""
    _cut(bench)
    _read_until_lost(bench, subject, "the link was cut")


def _read_until_lost(bench: Bench, subject: Subject, event: str) -> None:
    passed_s = 0.0
    while passed_s < bench.long_loss_s:
        subject.advance(subject.step_s)
        passed_s += subject.step_s
        try:
            subject.driver.read()
        except ConnectionLostError:
            return
    raise Unmet(f"reads go on {bench.long_loss_s:g} s after {event}; expected: ConnectionLostError")


@check(hooks=_HOOKS)
def short_loss(bench: Bench) -> None:
    """A short loss is masked: reads raise nothing and samples come again; nothing begins to move.

    What cannot be said to the device is refused once the driver knows that it is silent.
    """
    with bench.opened() as subject:
        driver, axis = subject.driver, subject.slow
        try:
            _cut(bench)
            subject.run(bench.short_loss_s)
            if driver.status().silent_s > 0.0:
                refused(
                    "a move to a silent device",
                    lambda: driver.move_to({axis.name: axis.low}),
                    StateError,
                )
        finally:
            _restore(bench)
        subject.run(bench.short_loss_s + 0.2)
        silent_s = driver.status().silent_s
        demand(silent_s == 0.0, f"the link is back, and silent for {silent_s:g} s", "0 s")
        subject.holds()


@check(hooks=_HOOKS)
def long_loss(bench: Bench) -> None:
    """After a long loss reads raise ConnectionLostError, and do so until the driver is closed."""
    with bench.opened() as subject:
        try:
            _lose(bench, subject)
        finally:
            _restore(bench)
        subject.advance(subject.step_s)
        refused("a read after the link was lost", subject.driver.read, DriverError)


@check(hooks=_HOOKS)
def nothing_resumes(bench: Bench) -> None:
    """When a lost link is back nothing moves; reopened, the device is at rest."""
    with bench.opened() as subject:
        driver, axis = subject.driver, subject.slow
        subject.cross(axis)
        subject.run(CATCH_S)
        try:
            _lose(bench, subject)
        except Unmet as found:
            raise Inapplicable("it does not give up a lost link (long-loss)") from found
        finally:
            _restore(bench)
        refused(
            "a move after the link was lost",
            lambda: driver.move_to({axis.name: axis.low}),
            DriverError,
        )
        driver.close()
        driver.open()
        subject.run(0.1)
        state = subject.state
        resting = state in (DeviceState.IDLE, DeviceState.FAULT)
        demand(resting, f"reopened after a loss it is {state}", "at rest")
        subject.holds(0.5)


def _demand_return(what: str, call: Callable[[], object], patience_s: float) -> None:
    """Demand that a call of another thread returns; raise what it raises."""
    raised: list[Exception] = []

    def run() -> None:
        try:
            call()
        except Exception as error:
            raised.append(error)

    thread = threading.Thread(target=run, name="caller of a check", daemon=True)
    thread.start()
    thread.join(patience_s)
    demand(not thread.is_alive(), f"{what} has not returned for {patience_s:g} s", "at once")
    if raised:
        raise raised[0]


@check(hooks=_BLOCK_HOOKS)
def blocked_port(bench: Bench) -> None:
    """With a port that takes no bytes a stop returns at once, and reads soon raise.

    They raise ConnectionLostError; when the port takes bytes again the device can be opened and
    moved.
    """
    assert bench.block_port is not None, "a check runs where its hooks are"
    assert bench.unblock_port is not None, "a check runs where its hooks are"
    with bench.opened() as subject:
        driver, axis = subject.driver, subject.slow
        subject.cross(axis)
        subject.run(CATCH_S)
        bench.block_port()
        try:
            _demand_return("a stop", driver.stop, _PATIENCE_S)
            _demand_return(
                "a read",
                lambda: _read_until_lost(bench, subject, "the port was blocked"),
                _READS_PATIENCE_S,
            )
        finally:
            bench.unblock_port()
        with suppress(DriverError):  # of the port that is lost
            driver.close()
        driver.open()
        subject.make_ready()
        target = subject.send(axis, axis.stroke(float(subject.command()[axis.index])))
        subject.rest()
        seen = float(subject.command()[axis.index])
        within(f"reopened, axis {axis.name} ends at", seen, target, axis.half_step, axis.unit)
