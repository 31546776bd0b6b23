"""Traces of the gate model, step by step on the real session.

A trace is an order in which actors and worker take their steps. Here every actor is a thread that
waits before each of these steps in the code of the session. Time is virtual.
"""

from contextlib import suppress
from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest
from tests.app.motion.gate_model import PROGRAMS, Model
from tests.app.motion.lockstep import DONE, Lock, Lockstep

from rotemina.app.motion.device import LiveHistory, SessionWorker, mailbox
from rotemina.app.motion.device.executor import CommandExecutor
from rotemina.app.motion.device.mailbox import Mailbox
from rotemina.app.motion.session.admission import RequestAdmission
from rotemina.drivers.contract import DriverError, Gate
from rotemina.sim.errors import InputError

OTHERS = ("stop", "emergency", "release", "disconnect", "reconnect", "use", "lose", "wait")
SINGLE_STEP_ACTORS = ("release", "reconnect", "lose", "wait")  # actors of one step
REST, TARGET, SPEED, LEASE_S = 0.0275, 0.05, 5e-3, 0.15
MIN_STEP_SHARE = 0.7  # of the steps; for example, the session halts a driver once, the model twice
BRAKING_TIME_S = 0.2
MAX_TRACES = 8  # of a move and two others or of a speed, chosen with a fixed seed


class TracedSession:
    """A session whose actors follow one trace."""

    def __init__(self, harness, monkeypatch, request_, others):
        self.harness, self.session, self.request = harness, harness.session, request_
        self.steps = Lockstep()
        self.first_driver = harness.driver
        self.other_driver = self._make_other_driver()
        self.begun_stops, self.returned_stops, self.stops_before_request = set(), set(), None
        self.has_written, self.violations = False, []
        self.session._admission.lock = Lock(self.steps)
        self.session._link.worker.ownership._lock = Lock(self.steps)
        monkeypatch.setattr(CommandExecutor, "_halt_if_overtaken", lambda *_: None)
        self._install_hooks(monkeypatch)
        for actor in (request_, *others):
            self.steps.start(actor, lambda actor=actor: self._act(actor))
        self.steps.start("worker", self._work)

    # The actors

    def _act(self, actor):
        if actor in SINGLE_STEP_ACTORS:
            self.steps.arrive(PROGRAMS[actor][0])
        with suppress(InputError):
            self._do(actor)

    def _do(self, actor):
        session = self.session
        if actor == "move":
            session.go_to({"x": TARGET})
        elif actor == "speed":
            session.move_velocity({"x": SPEED}, LEASE_S)
        elif actor == "emergency":
            session.emergency_stop()
        elif actor == "wait":
            self.harness.clock.advance(2.0 * LEASE_S)
        elif actor == "lose":
            self._lose(session._link.worker.driver)
        elif actor == "use":
            session.use_driver(self.other_driver)
        else:
            getattr(session, actor)()

    def _work(self):
        while True:
            self.steps.arrive("cycle")
            if self.steps._free:
                return
            self.session.run_once()

    def _lose(self, driver):
        driver.fail("read", DriverError("the link is lost"))
        driver.before["open"] = lambda: driver.before.pop("read", None)

    def _make_other_driver(self):
        arrive, kind = self.steps.arrive, type(self.first_driver)

        class OtherMachine(kind):
            """Another machine, which gets the gate of the session at the exchange."""

            @property
            def gate(self):
                return self._gate

            @gate.setter
            def gate(self, gate):
                if hasattr(self, "_gate"):
                    arrive("exchange")
                self._gate = gate

        return OtherMachine(self.session.robot, clock=self.harness.clock)

    # The calls in which the session takes the steps of the model

    def _install_hooks(self, monkeypatch):
        self._set = monkeypatch.setattr
        self._hook_requests()
        self._hook_stops()
        self._hook_worker()

    def _add_step(self, kind, name, step, when=lambda: True):
        """Take a step before a call; ``step`` is its name or returns it, or None."""
        function = getattr(kind, name)

        def step_and_call(*args, **kwargs):
            label = step() if callable(step) else step
            if label and when():
                self.steps.arrive(label)
                self._note(label)
            return function(*args, **kwargs)

        self._set(kind, name, step_and_call)

    def _is_requester(self):
        return self.steps.actor == self.request

    def _is_worker(self):
        return self.steps.actor == "worker"

    def _hook_requests(self):
        self._add_step(Gate, "permit", "draw", self._is_requester)
        self._add_step(RequestAdmission, "refuse_if_motion_blocked", "check", self._is_requester)
        self._add_step(mailbox, "refuse_invalidated_permit", "pass", self._is_requester)
        refuse = mailbox.refuse_invalidated_permit

        def refuse_and_step(permit):
            refuse(permit)
            if self._is_requester():
                self.steps.arrive("queue")

        self._set(mailbox, "refuse_invalidated_permit", refuse_and_step)
        names = {"disconnect": "connection nothing", "use": "connection own"}
        self._add_step(Mailbox, "request_connection", lambda: names.get(self.steps.actor))

    def _hook_stops(self):
        self._add_step(Gate, "stop", "shut")
        clear = Mailbox.clear

        def clear_with_steps(queue):
            self.steps.arrive("drop")
            clear(queue)
            if not self._is_worker():
                self.steps.arrive("look")

        self._set(Mailbox, "clear", clear_with_steps)
        driver = type(self.first_driver)
        self._add_step(driver, "halt", lambda: "halt own" if self._is_worker() else "halt")
        self._add_step(SessionWorker, "note_stop", "return")

    def _hook_worker(self):
        box, driver = self.session._link.mailbox, type(self.first_driver)
        self._add_step(
            Mailbox,
            "take_connection_request",
            "take connection",
            lambda: self._is_worker() and box._connection_request,
        )
        self._add_step(Mailbox, "take_command", "take", lambda: self._is_worker() and len(box) > 0)
        self._add_step(Gate, "start_connection", "reconnected")
        self._add_step(SessionWorker, "_use_driver", "exchange")
        self._add_step(driver, "open", "open")
        self._add_step(driver, "close", "close")
        self._add_step(LiveHistory, "clear", "connected")
        self._add_step(CommandExecutor, "_dispatch", "hand over")
        for name in ("_move_to", "_move_velocity"):
            function = getattr(driver, name)

            def write(*args, function=function):
                self.steps.arrive("write")
                function(*args)
                self._check_write()

            self._set(driver, name, write)

    def _note(self, step):
        actor = self.steps.actor
        if actor == self.request and step == "draw":
            self.stops_before_request = frozenset(self.begun_stops)
        elif actor not in ("worker", None) and step == "shut":
            self.begun_stops.add(actor)
        elif step == "return":
            self.returned_stops.add(actor)

    def _check_write(self):
        self.has_written = True
        if not self.returned_stops <= self.stops_before_request:
            self.violations.append(
                f"written after the return of {self.returned_stops - self.stops_before_request}"
            )
        if self.session._link.gate.latch_reason is not None:
            self.violations.append("written while a stop is latched")

    # The trace

    def go(self, model, trace):
        """Follow a trace, then run to the end; return the number of steps taken."""
        state, steps_taken = model.initial_state, 0
        for actor in trace:
            step = model.next_step(state, actor)
            state = model.step(state, actor)
            if actor == "worker":
                self.steps.go("worker", "cycle")  # if it has just ended a cycle
            steps_taken += self.steps.go(actor, step)
        self.steps.run_freely()
        for _ in range(3):
            self.session.run_once()
        return steps_taken

    def is_moving(self):
        """Return whether the connected machine goes on moving after the time to brake."""
        driver = self.session._link.worker.driver
        self._advance(BRAKING_TIME_S)
        before = np.array(driver.true_positions)
        self._advance(2.0 * BRAKING_TIME_S)
        return abs(driver.true_positions[0] - before[0]) > 1e-4

    def _advance(self, seconds):
        for _ in range(round(seconds / 0.02)):
            self.harness.clock.advance(0.02)
            self.session.run_once()


def run_traces(make_harness, request_, others, traces):
    """Follow traces on sessions; return the share of steps taken and the number of writes."""
    model, steps_taken, step_count, written_count = Model(request_, *others), 0, 0, 0
    for trace in traces:
        with pytest.MonkeyPatch.context() as monkeypatch:
            traced_session = TracedSession(make_harness(), monkeypatch, request_, others)
            steps_taken += traced_session.go(model, trace)
            step_count += len(trace)
            written_count += traced_session.has_written
            assert traced_session.violations == [], trace
            # A stop after the request halts the motion of the request.
            if (
                traced_session.stops_before_request is not None
                and not traced_session.returned_stops <= traced_session.stops_before_request
            ):
                assert not traced_session.is_moving(), trace
            assert set(traced_session.steps.at.values()) == {DONE}
    return steps_taken / step_count, written_count


@pytest.mark.parametrize("other", OTHERS)
def test_every_trace_with_one_other_actor_on_the_session(make_harness, other):
    traces = Model("move", other).walk().traces
    share, written = run_traces(make_harness, "move", (other,), traces)
    assert share > MIN_STEP_SHARE, "the session differs from the model"
    assert 0 < written < len(traces) or other in ("release", "reconnect", "wait")


def test_the_traces_find_a_session_that_stamps_its_permits_late(make_harness, monkeypatch):
    take_command = Mailbox.take_command

    def take_with_new_permit(queue):
        command = take_command(queue)
        if command is None:
            return None
        permit = command.permit
        return command._replace(permit=replace(permit, epoch=permit.gate.epoch))

    monkeypatch.setattr(Mailbox, "take_command", take_with_new_permit)
    with pytest.raises(AssertionError, match="written after the return"):
        run_traces(make_harness, "move", ("stop",), Model("move", "stop").walk().traces)


# A speed differs from a move in its lease, which matters only if somebody waits.
PAIRS = list(combinations(OTHERS, 2))
RUNS = [
    *(("speed", (other,)) for other in OTHERS),
    *(("move", pair) for pair in PAIRS),
    *(("speed", pair) for pair in PAIRS if "wait" in pair),
]


@pytest.mark.parametrize(("request_", "others"), RUNS, ids=str)
def test_the_model_has_no_violation_and_the_session_follows_its_traces(
    make_harness, request_, others
):
    walk = Model(request_, *others).walk()
    assert not walk.faults
    # The order in which the model finds them differs from run to run.
    traces = sorted(walk.traces)
    rng = np.random.default_rng(len(traces))
    indices = rng.choice(len(traces), min(MAX_TRACES, len(traces)), replace=False)
    run_traces(make_harness, request_, others, [traces[index] for index in indices])
