"""A small model of requests, worker, drivers and stops, of which every interleaving is walked.

Each actor is a list of atomic steps; between any two of them any other actor may take one of its
own. What must hold is judged by what happened, not by what the model's gate counts.
"""

from dataclasses import dataclass, field, replace
from typing import NamedTuple

STOP = ("shut", "drop", "look", "halt", "halt", "return")
PROGRAMS = {
    "move": ("draw", "check", "pass", "queue"),
    "speed": ("draw", "check", "pass", "queue"),  # with a lease
    "clear": ("draw", "check", "pass", "queue"),  # a fault
    "stop": STOP,
    "emergency": STOP,
    "release": ("release",),
    "disconnect": (*STOP, "connection nothing"),
    "reconnect": ("connection own",),
    "use": (*STOP, "exchange", "reconnected", "connection own"),
    "lose": ("lose",),  # the link
    "wait": ("wait",),  # until leases have run out
}
LET_GO = ("reconnected", "drop", "shut", "halt own", "close")
CONNECT = ("drop", "open", "reconnected", "connected")
#: Mistakes that the walk must find.
FLAWS = {
    "the permit is drawn after the check",
    "the permit is stamped when it is taken",
    "the gate is asked before the write alone",
    "the gate is shut after the drivers were told",
    "a latch is not looked at",
    "a stop reaches one driver alone",
    "a connection is not counted",
    "a lease is looked at before the write alone",
}


class Counts(NamedTuple):
    """Stops, connections and releases, as the gate counts them."""

    stops: int = 0
    connections: int = 0
    releases: int = 0


_NONE = Counts()


@dataclass(frozen=True, slots=True)
class Request:
    """What somebody asked, the permit, and what had happened before."""

    kind: str
    permit: Counts | None = None
    stops: frozenset[str] = frozenset()  # that had begun
    opening: int = 0


@dataclass(frozen=True, slots=True)
class State:
    """Everything that there is; equal states have an equal future."""

    at: tuple[int, ...]  # of each actor, its next step
    requests: tuple[Request, ...]  # of each actor, what it asks for, if it does
    seen: tuple[tuple[str, ...], ...]  # of each actor, the drivers that its stop has yet to tell
    counts: Counts = _NONE
    latched: bool = False
    queue: tuple[Request, ...] = ()
    hand: Request | None = None
    worker: tuple[str, ...] = ()  # what it does next
    connection_request: str | None = None
    session_driver: str = "a"
    worker_driver: str = "a"
    open: str | None = "a"
    moving: Request | None = None  # why the open driver's machine moves
    connected: bool = True
    opening: int = 0
    lost: bool = False
    lease_over: bool = False
    begun: frozenset[str] = frozenset()
    returned: frozenset[str] = frozenset()
    moved: frozenset[str] = frozenset()  # the kinds of requests that reached a device
    wrong: str | None = None


Trace = tuple[str, ...]


@dataclass(frozen=True)
class Walk:
    """What a walk has found: traces that between them come through every state, and faults."""

    states: int = 0
    traces: list[Trace] = field(default_factory=list)
    faults: dict[str, Trace] = field(default_factory=dict)


class Model:
    """A few actors and the worker, with one of :data:`FLAWS` or none."""

    def __init__(self, *actors: str, flaw: str | None = None) -> None:
        assert flaw is None or flaw in FLAWS
        self.actors = actors
        self.flaw = flaw
        self.programs = tuple(self._program(actor) for actor in actors)

    @property
    def beginning(self) -> State:
        """Connected, at rest."""
        none = tuple(() for _ in self.actors)
        return State(tuple(0 for _ in self.actors), tuple(map(Request, self.actors)), none)

    def _program(self, actor: str) -> tuple[str, ...]:
        steps = list(PROGRAMS[actor])
        if self.flaw == "the permit is drawn after the check" and steps[0] == "draw":
            steps[:2] = ["check", "draw"]
        if self.flaw == "the gate is shut after the drivers were told" and steps[0] == "shut":
            steps[:5] = ["drop", "look", "halt", "halt", "shut"]
        return tuple(steps)

    # --- walking ----------------------------------------------------------------------------------

    def able(self, state: State) -> list[str]:
        """Return the actors, the worker among them, that can take a step."""
        able = [
            actor
            for actor, program, at in zip(self.actors, self.programs, state.at, strict=True)
            if at < len(program)
        ]
        waits = state.connection_request or (state.connected and (state.queue or state.lost))
        return [*able, "worker"] if state.worker or waits else able

    def step(self, state: State, actor: str) -> State:
        """Return the state after an actor's next step."""
        after = self._work(state) if actor == "worker" else self._act(state, actor)
        moving = after.moving
        if moving is not None and not after.returned <= moving.stops and after.wrong is None:
            after = replace(after, wrong="something asked before a stop moves after its return")
        return after

    def next_step(self, state: State, actor: str) -> str:
        """Return what an actor's next step is called; "" where it is at its end."""
        if actor == "worker":
            return self._plan(state)[0]
        index = self.actors.index(actor)
        return "".join(self.programs[index][state.at[index] : state.at[index] + 1])

    def walk(self) -> Walk:
        """Take every step from every state that can be reached."""
        found = Walk()
        known = {self.beginning}
        pending: list[tuple[State, Trace]] = [(self.beginning, ())]
        while pending:
            state, trace = pending.pop()
            new = False
            for actor in self.able(state) if state.wrong is None else ():
                after = self.step(state, actor)
                if after not in known:
                    known.add(after)
                    pending.append((after, (*trace, actor)))
                    new = True
            if state.wrong is not None:
                found.faults.setdefault(state.wrong, trace)
            elif not new:
                found.traces.append(trace)
        return replace(found, states=len(known))

    # --- the gate ---------------------------------------------------------------------------------

    def _passes(self, state: State, request: Request, *, writes: bool = False) -> bool:
        permit = request.permit
        assert permit is not None
        if writes and self.flaw == "the gate is asked before the write alone":
            return True
        latched = state.latched and self.flaw != "a latch is not looked at"
        late = request.kind == "speed" and state.lease_over
        if writes and self.flaw == "a lease is looked at before the write alone":
            late = False
        exchanged = state.session_driver != state.worker_driver
        return not (permit != state.counts or latched or late or exchanged or not state.connected)

    def _shut(self, state: State, *, latch: bool = False) -> State:
        counts = state.counts._replace(stops=state.counts.stops + 1)
        return replace(state, counts=counts, latched=state.latched or latch)

    def _reconnected(self, state: State) -> State:
        if self.flaw == "a connection is not counted":
            return state
        counts = state.counts._replace(connections=state.counts.connections + 1)
        return replace(state, counts=counts)

    # --- those who ask ----------------------------------------------------------------------------

    def _act(self, state: State, actor: str) -> State:
        index = self.actors.index(actor)
        step = self.programs[index][state.at[index]]
        state = replace(state, at=_with(state.at, index, state.at[index] + 1))
        if step in ("draw", "check", "pass", "queue"):
            return self._ask(state, index, step)
        if step in ("shut", "drop", "look", "halt", "return"):
            return self._halt(state, index, step)
        if step == "release":
            counts = state.counts._replace(releases=state.counts.releases + 1)
            return replace(state, counts=counts, latched=False)
        if step == "connection own":
            if actor == "reconnect" and state.connected:
                return state
            return replace(state, connection_request=state.session_driver)
        if step == "connection nothing":
            return replace(state, connection_request="nothing")
        if step == "exchange":
            return replace(state, session_driver="b")
        if step == "reconnected":
            return self._reconnected(state)
        return replace(state, lost=True) if step == "lose" else replace(state, lease_over=True)

    def _ask(self, state: State, index: int, step: str) -> State:
        request = state.requests[index]
        if step == self.programs[index][0]:
            request = replace(request, stops=state.begun, opening=state.opening)
        if step == "draw":
            request = replace(request, permit=state.counts)
        state = replace(state, requests=_with(state.requests, index, request))
        exchanged = state.session_driver != state.worker_driver
        refused = {
            "check": (state.latched and self.flaw != "a latch is not looked at")
            or exchanged
            or not state.connected,
            "pass": step == "pass" and not self._passes(state, request),
        }
        if refused.get(step):
            return replace(state, at=_with(state.at, index, len(self.programs[index])))
        return replace(state, queue=(*state.queue, request)) if step == "queue" else state

    def _halt(self, state: State, index: int, step: str) -> State:
        actor = self.actors[index]
        if step == self.programs[index][0]:
            state = replace(state, begun=state.begun | {actor})
        if step == "shut":
            return self._shut(state, latch=actor == "emergency")
        if step == "drop":
            return replace(state, queue=())
        if step == "look":
            drivers = (state.worker_driver, state.session_driver)
            if self.flaw == "a stop reaches one driver alone":
                drivers = (state.session_driver, state.session_driver)
            return replace(state, seen=_with(state.seen, index, drivers))
        if step == "halt":
            driver, *left = state.seen[index]
            state = replace(state, seen=_with(state.seen, index, tuple(left)))
            return _halted(state, driver)
        return replace(state, returned=state.returned | {actor})

    # --- the worker -------------------------------------------------------------------------------

    def _plan(self, state: State) -> tuple[str, ...]:
        """Return what the worker does next: what it has begun, or what waits for it."""
        if state.worker:
            return state.worker
        if state.connection_request is not None:
            return ("take connection",)
        return ("take", "hand over", "write") if state.queue else ("fail", *LET_GO)

    def _work(self, state: State) -> State:
        step, *left = self._plan(state)
        state = replace(state, worker=tuple(left))
        if step == "take connection":
            return self._take_connection(state)
        if step == "take":
            return self._take(state)
        if step in ("hand over", "write"):
            return self._hand_over(state, writes=step == "write")
        if step == "reconnected":
            return self._reconnected(state)
        if step == "shut":
            return self._shut(state)
        return self._connect(state, step, left)

    def _connect(self, state: State, step: str, left: list[str]) -> State:
        if step == "drop":
            return replace(state, queue=(), hand=None)
        if step == "halt own":
            return _halted(state, state.worker_driver)
        if step == "close":
            return replace(state, open=None, moving=None, connected=False)
        if step == "exchange":
            return replace(state, worker_driver=left[0], worker=tuple(left[1:]))
        if step == "open":
            return replace(state, open=state.worker_driver, opening=state.opening + 1, lost=False)
        return replace(state, connected=True) if step == "connected" else state

    def _take_connection(self, state: State) -> State:
        wanted, steps = state.connection_request, ()
        if wanted != state.worker_driver:
            steps = LET_GO
        if wanted not in (state.worker_driver, "nothing"):
            steps = (*steps, "exchange", str(wanted), *CONNECT)
        elif wanted == state.worker_driver and not state.connected:
            steps = CONNECT
        return replace(state, connection_request=None, worker=steps)

    def _take(self, state: State) -> State:
        if not state.queue:  # a stop has dropped it meanwhile
            return replace(state, worker=())
        request, *queue = state.queue
        if self.flaw == "the permit is stamped when it is taken":
            request = replace(request, permit=state.counts)
        return replace(state, hand=request, queue=tuple(queue))

    def _hand_over(self, state: State, *, writes: bool) -> State:
        request = state.hand
        if request is None or not self._passes(state, request, writes=writes):
            return replace(state, hand=None, worker=())
        return self._written(replace(state, hand=None), request) if writes else state

    def _written(self, state: State, request: Request) -> State:
        wrong = None
        if not state.returned <= request.stops:
            wrong = "something is written after the return of a stop that it was asked before"
        elif state.latched:
            wrong = "something is written while a stop is latched"
        elif request.opening != state.opening or state.open is None:
            wrong = "something is written that was asked of an earlier connection"
        elif request.kind == "speed" and state.lease_over:
            wrong = "a speed is written whose lease has run out"
        moving = state.moving if request.kind == "clear" else request
        return replace(state, moving=moving, moved=state.moved | {request.kind}, wrong=wrong)


def _with(values, index, value):
    return (*values[:index], value, *values[index + 1 :])


def _halted(state: State, driver: str) -> State:
    return replace(state, moving=None) if state.open == driver else state
