"""The model's own traces, step by step, on the real session: its threads take their steps in turn.

A trace of the model is an order in which actors and worker take their steps. Here every actor is a
thread that waits before each of these steps, in the session's own code. Time is virtual.
"""

import sys
from contextlib import suppress
from dataclasses import replace
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest

from rotemina.app.motion import mailbox
from rotemina.app.motion.admission import Admission
from rotemina.app.motion.executor import Executor
from rotemina.app.motion.mailbox import Mailbox
from rotemina.app.motion.recent_history import LiveHistory
from rotemina.app.motion.worker import Worker
from rotemina.drivers.errors import DriverError
from rotemina.drivers.gate import Gate
from rotemina.sim.errors import InputError

sys.path.insert(0, str(Path(__file__).parent))  # no test modules: the model, and the threads

from gate_model import PROGRAMS, Model
from lockstep import DONE, Lock, Lockstep

OTHERS = ("stop", "emergency", "release", "disconnect", "reconnect", "use", "lose", "wait")
WHOLE = ("release", "reconnect", "lose", "wait")  # actors of one step
REST, TARGET, SPEED, LEASE_S = 0.0275, 0.05, 5e-3, 0.15
LEAST_SHARE = 0.7  # of steps: a driver is told once where the model tells it twice, and so on
MOST_TRACES = 8  # of three actors: a share of them, by a fixed seed


class Traced:
    """A session whose actors go the way of one trace."""

    def __init__(self, stepped, monkeypatch, request_, others):
        self.stepped, self.session, self.request = stepped, stepped.session, request_
        self.steps = Lockstep()
        self.first = stepped.driver
        self.other = self._made_other()
        self.begun, self.returned, self.before = set(), set(), None
        self.written, self.wrong = False, []
        self.session._admission.lock = Lock(self.steps)
        self.session._link.worker.ownership._lock = Lock(self.steps)
        monkeypatch.setattr(Executor, "_halt_if_overtaken", lambda *_: None)
        self._hook(monkeypatch)
        for actor in (request_, *others):
            self.steps.start(actor, lambda actor=actor: self._act(actor))
        self.steps.start("worker", self._work)

    # --- the actors -------------------------------------------------------------------------------

    def _act(self, actor):
        if actor in WHOLE:
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
            self.stepped.clock.advance(2.0 * LEASE_S)
        elif actor == "lose":
            self._lose(session._link.worker.driver)
        elif actor == "use":
            session.use(self.other)
        else:
            getattr(session, actor)()

    def _work(self):
        while True:
            self.steps.arrive("cycle")
            if self.steps._free:
                return
            self.session.run_once()

    def _lose(self, driver):
        def silent():
            raise DriverError("the link is lost")

        driver.before["read"] = silent
        driver.before["open"] = lambda: driver.before.pop("read", None)

    def _made_other(self):
        arrive, kind = self.steps.arrive, type(self.first)

        class Other(kind):
            """Another machine, which is put behind the session's gate at the exchange."""

            @property
            def gate(self):
                return self._gate

            @gate.setter
            def gate(self, gate):
                if hasattr(self, "_gate"):
                    arrive("exchange")
                self._gate = gate

        return Other(self.session.robot, clock=self.stepped.clock)

    # --- where the session takes the model's steps ------------------------------------------------

    def _hook(self, monkeypatch):
        self._set = monkeypatch.setattr
        self._hook_those_who_ask()
        self._hook_stops()
        self._hook_the_worker()

    def _before(self, kind, name, step, when=lambda: True):
        """Have a step taken before a call, where that is one: ``step`` names it, or returns it."""
        inner = getattr(kind, name)

        def hooked(*given, **named):
            label = step() if callable(step) else step
            if label and when():
                self.steps.arrive(label)
                self._note(label)
            return inner(*given, **named)

        self._set(kind, name, hooked)

    def _asks(self):
        return self.steps.actor == self.request

    def _works(self):
        return self.steps.actor == "worker"

    def _hook_those_who_ask(self):
        self._before(Gate, "permit", "draw", self._asks)
        self._before(Admission, "refuse_if_locked", "check", self._asks)
        self._before(mailbox, "refuse_overtaken", "pass", self._asks)
        compare = mailbox.refuse_overtaken

        def compared(permit):
            compare(permit)
            if self._asks():
                self.steps.arrive("queue")

        self._set(mailbox, "refuse_overtaken", compared)
        names = {"disconnect": "connection nothing", "use": "connection own"}
        self._before(Mailbox, "request_connection", lambda: names.get(self.steps.actor))

    def _hook_stops(self):
        self._before(Gate, "stop", "shut")
        clear = Mailbox.clear

        def cleared(own):
            self.steps.arrive("drop")
            clear(own)
            if not self._works():
                self.steps.arrive("look")

        self._set(Mailbox, "clear", cleared)
        driver = type(self.first)
        self._before(driver, "halt", lambda: "halt own" if self._works() else "halt")
        self._before(Worker, "stopped", "return")

    def _hook_the_worker(self):
        box, driver = self.session._link.mailbox, type(self.first)
        self._before(
            Mailbox,
            "take_connection_request",
            "take connection",
            lambda: self._works() and box._connection_request,
        )
        self._before(Mailbox, "take", "take", lambda: self._works() and len(box) > 0)
        self._before(Gate, "reconnected", "reconnected")
        self._before(Worker, "_use", "exchange")
        self._before(driver, "open", "open")
        self._before(driver, "close", "close")
        self._before(LiveHistory, "clear", "connected")
        self._before(Executor, "_hand_over", "hand over")
        for name in ("_move_to", "_move_velocity"):
            inner = getattr(driver, name)

            def write(*given, inner=inner):
                self.steps.arrive("write")
                inner(*given)
                self._wrote()

            self._set(driver, name, write)

    def _note(self, step):
        actor = self.steps.actor
        if actor == self.request and step == "draw":
            self.before = frozenset(self.begun)
        elif actor not in ("worker", None) and step == "shut":
            self.begun.add(actor)
        elif step == "return":
            self.returned.add(actor)

    def _wrote(self):
        self.written = True
        if not self.returned <= self.before:
            self.wrong.append(f"written after the return of {self.returned - self.before}")
        if self.session._link.gate.latched is not None:
            self.wrong.append("written while a stop is latched")

    # --- the trace --------------------------------------------------------------------------------

    def go(self, model, trace):
        """Go a trace, then everything to its end; return how many of its steps were gone."""
        state, gone = model.beginning, 0
        for actor in trace:
            step = model.next_step(state, actor)
            state = model.step(state, actor)
            if actor == "worker":
                self.steps.go("worker", "cycle")  # where it has just ended one
            gone += self.steps.go(actor, step)
        self.steps.let_go()
        for _ in range(3):
            self.session.run_once()
        return gone

    def moves(self):
        """Tell whether the machine that is connected goes anywhere from now on."""
        driver = self.session._link.worker.driver
        before = np.array(driver.true_positions)
        for _ in range(20):
            self.stepped.clock.advance(0.02)
            self.session.run_once()
        return abs(driver.true_positions[0] - before[0]) > 1e-4


def goes(make_stepped, request_, others, traces):
    """Let sessions go traces; return the share of steps that they took as the model does."""
    model, gone, steps, written = Model(request_, *others), 0, 0, 0
    for trace in traces:
        with pytest.MonkeyPatch.context() as monkeypatch:
            traced = Traced(make_stepped(), monkeypatch, request_, others)
            gone += traced.go(model, trace)
            steps += len(trace)
            written += traced.written
            assert traced.wrong == [], trace
            # Each stop that was asked for after the request halts what that began.
            if traced.before is not None and not traced.returned <= traced.before:
                assert not traced.moves(), trace
            assert set(traced.steps.at.values()) == {DONE}
    return gone / steps, written


@pytest.mark.parametrize("other", OTHERS)
def test_every_trace_beside_one_other_on_the_session(make_stepped, other):
    traces = Model("move", other).walk().traces
    share, written = goes(make_stepped, "move", (other,), traces)
    assert share > LEAST_SHARE, "the session goes other ways than the model"
    assert 0 < written < len(traces) or other in ("release", "reconnect", "wait")


def test_the_traces_find_a_session_that_stamps_its_permits_late(make_stepped, monkeypatch):
    take = Mailbox.take

    def stamped(own):
        posted = take(own)
        if posted is None:
            return None
        permit = posted.permit
        return posted._replace(permit=replace(permit, epoch=permit.gate.epoch))

    monkeypatch.setattr(Mailbox, "take", stamped)
    with pytest.raises(AssertionError, match="written after the return"):
        goes(make_stepped, "move", ("stop",), Model("move", "stop").walk().traces)


@pytest.mark.slow
@pytest.mark.parametrize("other", OTHERS)
def test_every_trace_of_a_speed_beside_one_other_on_the_session(make_stepped, other):
    goes(make_stepped, "speed", (other,), Model("speed", other).walk().traces)


@pytest.mark.slow
@pytest.mark.parametrize("request_", ["move", "speed"])
@pytest.mark.parametrize("others", list(combinations(OTHERS, 2)))
def test_traces_beside_any_two_others_on_the_session(make_stepped, request_, others):
    traces = Model(request_, *others).walk().traces
    rng = np.random.default_rng(len(traces))
    chosen = rng.choice(len(traces), min(MOST_TRACES, len(traces)), replace=False)
    goes(make_stepped, request_, others, [traces[k] for k in chosen])
