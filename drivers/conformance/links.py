"""Checks of a driver's behaviour when its link is cut."""

from rotemina.drivers.conformance.bench import Bench
from rotemina.drivers.conformance.check import check
from rotemina.drivers.conformance.driver_under_test import CATCH_S, Subject
from rotemina.drivers.conformance.findings import Inapplicable, Unmet, demand, refused
from rotemina.drivers.errors import ConnectionLostError, DriverError, StateError
from rotemina.drivers.samples import DeviceState

_HOOKS = ("cut_link", "restore_link")


def _cut(bench: Bench) -> None:
    assert bench.cut_link is not None, "a check runs where its hooks are"
    bench.cut_link()


def _restore(bench: Bench) -> None:
    assert bench.restore_link is not None, "a check runs where its hooks are"
    bench.restore_link()


def _lose(bench: Bench, subject: Subject) -> None:
    """Cut the link and read on until the driver gives up."""
    _cut(bench)
    passed_s = 0.0
    while passed_s < bench.long_loss_s:
        subject.advance(subject.step_s)
        passed_s += subject.step_s
        try:
            subject.driver.read()
        except ConnectionLostError:
            return
    raise Unmet(
        f"reads go on {bench.long_loss_s:g} s after the link was cut; expected: ConnectionLostError"
    )


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
