"""Every interleaving of requests, stops and connections; and the session goes the model's ways."""

import sys
import threading
from collections import defaultdict
from contextlib import suppress
from itertools import combinations, combinations_with_replacement, product
from pathlib import Path

import pytest

from rotemina.app.motion import mailbox
from rotemina.app.motion.executor import Executor
from rotemina.drivers.errors import DriverError
from rotemina.sim.errors import InputError

sys.path.insert(0, str(Path(__file__).parent))  # no test module: the model

from gate_model import FLAWS, Model

OTHERS = ("stop", "emergency", "release", "disconnect", "reconnect", "use", "lose", "wait")
EVENTS = OTHERS[:-1]
WAYS = {  # actors among whom each flaw shows
    "the permit is drawn after the check": ("move", "stop"),
    "the permit is stamped when it is taken": ("move", "stop"),
    "the gate is asked before the write alone": ("move", "stop"),
    "the gate is shut after the drivers were told": ("move", "stop"),
    "a latch is not looked at": ("clear", "emergency"),
    "a stop reaches one driver alone": ("move", "stop", "use"),
    "a connection is not counted": ("move", "use"),
    "a lease is looked at before the write alone": ("speed", "wait"),
}
REST, TARGET = 0.0275, 0.05


@pytest.mark.parametrize("request_name", ["move", "speed", "clear"])
@pytest.mark.parametrize("other", OTHERS)
def test_nothing_passes_that_must_not_beside_one_other(request_name, other):
    walk = Model(request_name, other).walk()
    assert walk.states > 10
    assert not walk.faults


@pytest.mark.parametrize(
    "others", [("stop", "use"), ("emergency", "release"), ("lose", "reconnect")]
)
def test_nothing_passes_that_must_not_beside_two_others(others):
    assert not Model("move", *others).walk().faults


@pytest.mark.slow
@pytest.mark.parametrize("request_name", ["move", "speed", "clear"])
@pytest.mark.parametrize("others", list(combinations(OTHERS, 2)))
def test_nothing_passes_that_must_not_beside_any_two_others(request_name, others):
    assert not Model(request_name, *others).walk().faults


@pytest.mark.parametrize("flaw", sorted(FLAWS))
def test_the_walk_finds_each_flaw(flaw):
    assert Model(*WAYS[flaw], flaw=flaw).walk().faults


# --- the same ways on the session -----------------------------------------------------------------

PLACES = ("draw", "check", "pass", "queue", "take", "hand over", "write", "end")


def modelled(plan):
    """Go a way in which others act whole, each right before a step; return whether it moved."""
    actors = ("move", *dict.fromkeys(event for _, event in plan if event != "turn"))
    model = Model(*actors)
    state = model.beginning

    def act(actor):
        nonlocal state
        while actor in model.able(state):
            state = model.step(state, actor)

    for place in PLACES:
        for event in [event for at, event in plan if at == place]:
            act("worker" if event == "turn" else event)
        mover = "move" if place in PLACES[:4] else "worker"
        if place != "end" and mover in model.able(state) and model.next_step(state, mover) == place:
            state = model.step(state, mover)
    act("worker")
    assert state.wrong is None
    return "move" in state.moved, state.moving is not None


class Way:
    """A session in virtual time, in which others act at the places of a request's way."""

    def __init__(self, stepped, plan, monkeypatch):
        self.stepped, self.session = stepped, stepped.session
        self.plan = defaultdict(list)
        for place, event in plan:
            self.plan[place].append(event)
        self.written = False
        self.session._admission.lock = (
            threading.RLock()
        )  # the others act on the thread of the request
        self._hook(monkeypatch)

    def _hook(self, monkeypatch):
        session = self.session
        before = [
            (session._admission, "drawn", "draw"),
            (session._admission, "refuse_if_locked", "check"),
            (session._link.mailbox, "post", "pass"),
            (session._link.mailbox, "take", "take"),
            (Executor, "_hand_over", "hand over"),
            (type(self.stepped.driver), "_move_to", "write"),
        ]
        for owner, name, place in before:
            monkeypatch.setattr(owner, name, self._after(place, getattr(owner, name)))
        compare = mailbox.refuse_overtaken

        def compared(permit):
            compare(permit)
            self.arrive("queue")

        monkeypatch.setattr(mailbox, "refuse_overtaken", compared)
        monkeypatch.setattr(Executor, "_halt_if_overtaken", lambda *_: None)

    def _after(self, place, inner):
        def hooked(*given, **named):
            if place != "take" or len(self.session._link.mailbox):
                self.arrive(place)
            found = inner(*given, **named)
            self.written |= place == "write"
            return found

        return hooked

    def arrive(self, place):
        events, self.plan[place] = self.plan[place], []
        for event in events:
            with suppress(InputError):
                self.do(event)

    def do(self, event):
        session, driver = self.session, self.stepped.driver
        if event == "emergency":
            session.emergency_stop()
        elif event == "turn":
            session.run_once()
        elif event == "use":
            new = type(driver)(session.robot, clock=self.stepped.clock)
            session.use(new)
        elif event == "lose":
            self.lose(session._link.worker.driver)
        else:
            getattr(session, event)()

    def lose(self, driver):
        def silent():
            raise DriverError("the link is lost")

        driver.before["read"] = silent
        driver.before["open"] = lambda: driver.before.pop("read", None)

    def gone(self):
        """Go the way; return whether something was written, and whether it moves."""
        with suppress(InputError):
            self.session.go_to({"x": TARGET})
        self.session.run_once()
        for place in PLACES:  # which the request has not come to
            self.arrive(place)
        self.session.run_once()
        self.stepped.step(0.05, 10)
        driver = self.session._link.worker.driver
        return self.written, driver.true_positions[0] > REST + 1e-3


def ways_beside_one():
    for place, event in product(PLACES, EVENTS):
        yield ((place, event),)
        if place in PLACES[:4]:
            yield ((place, event), (place, "turn"))


@pytest.mark.parametrize("plan", list(ways_beside_one()), ids=str)
def test_the_session_goes_the_ways_of_the_model(stepped, monkeypatch, plan):
    assert Way(stepped, plan, monkeypatch).gone() == modelled(plan)


def ways_beside_two():
    for (first, second), event, other in product(
        combinations_with_replacement(PLACES, 2), EVENTS, ("release", "reconnect", "stop")
    ):
        if event != other:
            yield ((first, event), (second, other))


@pytest.mark.slow
@pytest.mark.parametrize("plan", list(ways_beside_two()), ids=str)
def test_the_session_goes_the_ways_of_the_model_beside_two(stepped, monkeypatch, plan):
    assert Way(stepped, plan, monkeypatch).gone() == modelled(plan)
