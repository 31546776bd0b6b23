"""Every interleaving of requests, stops and connections, in the model and in the session."""

import sys
import threading
from collections import defaultdict
from contextlib import suppress
from itertools import combinations, combinations_with_replacement, product
from pathlib import Path

import pytest

from rotemina.app.motion.device import mailbox
from rotemina.app.motion.device.executor import CommandExecutor
from rotemina.drivers.contract import DriverError
from rotemina.sim.errors import InputError

sys.path.insert(0, str(Path(__file__).parent))  # for the model

from gate_model import FLAWS, Model

OTHERS = ("stop", "emergency", "release", "disconnect", "reconnect", "use", "lose", "wait")
EVENTS = OTHERS[:-1]
ACTORS_BY_FLAW = {  # actors that reveal each flaw
    "the permit is drawn after the check": ("move", "stop"),
    "the permit is stamped when it is taken": ("move", "stop"),
    "the gate is checked only before the write": ("move", "stop"),
    "the gate is shut after the drivers were halted": ("move", "stop"),
    "a latch is not checked": ("clear", "emergency"),
    "a stop reaches only one driver": ("move", "stop", "use"),
    "a connection is not counted": ("move", "use"),
    "a lease is checked only before the write": ("speed", "wait"),
}
REST, TARGET = 0.0275, 0.05


@pytest.mark.parametrize("request_name", ["move", "speed", "clear"])
@pytest.mark.parametrize("other", OTHERS)
def test_no_violation_with_one_other_actor(request_name, other):
    walk = Model(request_name, other).walk()
    assert walk.states > 10
    assert not walk.faults


@pytest.mark.parametrize(
    "others", [("stop", "use"), ("emergency", "release"), ("lose", "reconnect")]
)
def test_no_violation_with_two_other_actors(others):
    assert not Model("move", *others).walk().faults


@pytest.mark.slow
@pytest.mark.parametrize("request_name", ["move", "speed", "clear"])
@pytest.mark.parametrize("others", list(combinations(OTHERS, 2)))
def test_no_violation_with_any_two_other_actors(request_name, others):
    assert not Model(request_name, *others).walk().faults


@pytest.mark.parametrize("flaw", sorted(FLAWS))
def test_the_walk_finds_each_flaw(flaw):
    assert Model(*ACTORS_BY_FLAW[flaw], flaw=flaw).walk().faults


# The same sequences on the session

STEPS = ("draw", "check", "pass", "queue", "take", "hand over", "write", "end")


def run_model(plan):
    """Run a plan, in which each event happens completely before a step of the request.

    Return whether the request was executed, and whether the machine moves.
    """
    actors = ("move", *dict.fromkeys(event for _, event in plan if event != "turn"))
    model = Model(*actors)
    state = model.initial_state

    def act(actor):
        nonlocal state
        while actor in model.find_ready_actors(state):
            state = model.step(state, actor)

    for step in STEPS:
        for event in [event for event_step, event in plan if event_step == step]:
            act("worker" if event == "turn" else event)
        mover = "move" if step in STEPS[:4] else "worker"
        if (
            step != "end"
            and mover in model.find_ready_actors(state)
            and model.next_step(state, mover) == step
        ):
            state = model.step(state, mover)
    act("worker")
    assert state.violation is None
    return "move" in state.executed_kinds, state.moving is not None


class InterceptedRequest:
    """A session in virtual time, with events before the steps of a request."""

    def __init__(self, harness, plan, monkeypatch):
        self.harness, self.session = harness, harness.session
        self.plan = defaultdict(list)
        for step, event in plan:
            self.plan[step].append(event)
        self.has_written = False
        # The events happen on the thread of the request.
        self.session._admission.lock = threading.RLock()
        self._intercept(monkeypatch)

    def _intercept(self, monkeypatch):
        session = self.session
        interceptions = [
            (session._admission, "resolve_permit", "draw"),
            (session._admission, "refuse_if_motion_blocked", "check"),
            (session._link.mailbox, "post", "pass"),
            (session._link.mailbox, "take_command", "take"),
            (CommandExecutor, "_dispatch", "hand over"),
            (type(self.harness.driver), "_move_to", "write"),
        ]
        for owner, name, step in interceptions:
            monkeypatch.setattr(owner, name, self._intercept_before(step, getattr(owner, name)))
        compare = mailbox.refuse_invalidated_permit

        def refuse_and_intercept(permit):
            compare(permit)
            self.run_events("queue")

        monkeypatch.setattr(mailbox, "refuse_invalidated_permit", refuse_and_intercept)
        monkeypatch.setattr(CommandExecutor, "_halt_if_overtaken", lambda *_: None)

    def _intercept_before(self, step, function):
        def intercepted(*args, **kwargs):
            if step != "take" or len(self.session._link.mailbox):
                self.run_events(step)
            result = function(*args, **kwargs)
            self.has_written |= step == "write"
            return result

        return intercepted

    def run_events(self, step):
        events, self.plan[step] = self.plan[step], []
        for event in events:
            with suppress(InputError):
                self.run_event(event)

    def run_event(self, event):
        session, driver = self.session, self.harness.driver
        if event == "emergency":
            session.emergency_stop()
        elif event == "turn":
            session.run_once()
        elif event == "use":
            new = type(driver)(session.robot, clock=self.harness.clock)
            session.use_driver(new)
        elif event == "lose":
            self.lose_link(session._link.worker.driver)
        else:
            getattr(session, event)()

    def lose_link(self, driver):
        def fail_to_read():
            raise DriverError("the link is lost")

        driver.before["read"] = fail_to_read
        driver.before["open"] = lambda: driver.before.pop("read", None)

    def run(self):
        """Run the request; return whether something was written, and whether the machine moves."""
        with suppress(InputError):
            self.session.go_to({"x": TARGET})
        self.session.run_once()
        for step in STEPS:  # the steps that the request did not reach
            self.run_events(step)
        self.session.run_once()
        self.harness.step(0.05, 10)
        driver = self.session._link.worker.driver
        return self.has_written, driver.true_positions[0] > REST + 1e-3


def make_plans_with_one_event():
    for step, event in product(STEPS, EVENTS):
        yield ((step, event),)
        if step in STEPS[:4]:
            yield ((step, event), (step, "turn"))


@pytest.mark.parametrize("plan", list(make_plans_with_one_event()), ids=str)
def test_the_session_behaves_like_the_model(harness, monkeypatch, plan):
    assert InterceptedRequest(harness, plan, monkeypatch).run() == run_model(plan)


def make_plans_with_two_events():
    for (first, second), event, other in product(
        combinations_with_replacement(STEPS, 2), EVENTS, ("release", "reconnect", "stop")
    ):
        if event != other:
            yield ((first, event), (second, other))


@pytest.mark.slow
@pytest.mark.parametrize("plan", list(make_plans_with_two_events()), ids=str)
def test_the_session_behaves_like_the_model_with_two_events(harness, monkeypatch, plan):
    assert InterceptedRequest(harness, plan, monkeypatch).run() == run_model(plan)
