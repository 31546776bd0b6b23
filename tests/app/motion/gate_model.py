"""Small model of requests, worker, drivers and stops that walks through all interleavings.

Each actor is a list of atomic steps; between any two of them any other actor may take a step. The
required properties are checked on the events themselves, not on the counters of the gate.
"""

from dataclasses import dataclass, field, replace
from typing import NamedTuple

STOP_STEPS = ("shut", "drop", "look", "halt", "halt", "return")
PROGRAMS = {
    "move": ("draw", "check", "pass", "queue"),
    # A speed command has a lease.
    "speed": ("draw", "check", "pass", "queue"),
    # Clears a fault.
    "clear": ("draw", "check", "pass", "queue"),
    "stop": STOP_STEPS,
    "emergency": STOP_STEPS,
    "release": ("release",),
    "disconnect": (*STOP_STEPS, "connection nothing"),
    "reconnect": ("connection own",),
    "use": (*STOP_STEPS, "exchange", "reconnected", "connection own"),
    # The link is lost.
    "lose": ("lose",),
    # Waits until leases have expired.
    "wait": ("wait",),
}
DISCONNECT_STEPS = ("reconnected", "drop", "shut", "halt own", "close")
CONNECT_STEPS = ("drop", "open", "reconnected", "connected")
#: Mistakes in the gate that the walk must find, with the actors that reveal them.
FLAWS = {
    "the permit is drawn after the check": ("move", "stop"),
    "the permit is stamped when it is taken": ("move", "stop"),
    "the gate is checked only before the write": ("move", "stop"),
    "the gate is shut after the drivers were halted": ("move", "stop"),
    "a latch is not checked": ("clear", "emergency"),
    "a stop reaches only one driver": ("move", "stop", "use"),
    "a connection is not counted": ("move", "use"),
    "a lease is checked only before the write": ("speed", "wait"),
}


class Counts(NamedTuple):
    """The numbers of stops, connections and releases, as counted by the gate."""

    stops: int = 0
    connections: int = 0
    releases: int = 0


_NO_COUNTS = Counts()


class Request(NamedTuple):
    """A request with its permit, and the events before it."""

    kind: str
    permit: Counts | None = None
    # The stops that began before the request.
    stops: frozenset[str] = frozenset()
    opening: int = 0


class State(NamedTuple):
    """The complete state of the model; equal states have an equal future."""

    # Index of the next step of each actor.
    at: tuple[int, ...]
    # The request of each actor.
    requests: tuple[Request, ...]
    # The drivers that the stop of each actor still has to halt.
    drivers_to_halt: tuple[tuple[str, ...], ...]
    counts: Counts = _NO_COUNTS
    latched: bool = False
    queue: tuple[Request, ...] = ()
    current_request: Request | None = None
    # The next steps of the worker.
    worker: tuple[str, ...] = ()
    connection_request: str | None = None
    session_driver: str = "a"
    worker_driver: str = "a"
    open: str | None = "a"
    # The request that the machine of the open driver executes.
    moving: Request | None = None
    connected: bool = True
    opening: int = 0
    lost: bool = False
    lease_over: bool = False
    begun_stops: frozenset[str] = frozenset()
    returned_stops: frozenset[str] = frozenset()
    violation: str | None = None


Trace = tuple[str, ...]


@dataclass(frozen=True)
class Walk:
    """Result of a walk: traces that together visit every state, and the faults."""

    states: int = 0
    traces: list[Trace] = field(default_factory=list)
    faults: dict[str, Trace] = field(default_factory=dict)


class Model:
    """Several actors and the worker, optionally with one of the :data:`FLAWS`."""

    def __init__(self, *actors: str, flaw: str | None = None) -> None:
        assert flaw is None or flaw in FLAWS
        self.actors = actors
        self.flaw = flaw
        self.programs = tuple(self._program(actor) for actor in actors)

    @property
    def initial_state(self) -> State:
        """The initial state: connected, at rest."""
        none = tuple(() for _ in self.actors)
        return State(tuple(0 for _ in self.actors), tuple(map(Request, self.actors)), none)

    def _program(self, actor: str) -> tuple[str, ...]:
        steps = list(PROGRAMS[actor])
        if self.flaw == "the permit is drawn after the check" and steps[0] == "draw":
            steps[:2] = ["check", "draw"]
        if self.flaw == "the gate is shut after the drivers were halted" and steps[0] == "shut":
            steps[:5] = ["drop", "look", "halt", "halt", "shut"]
        return tuple(steps)

    def find_ready_actors(self, state: State) -> list[str]:
        """Return the actors that can take a step; the worker may be among them."""
        ready_actors = [
            actor
            for actor, program, at in zip(self.actors, self.programs, state.at, strict=True)
            if at < len(program)
        ]
        waits = state.connection_request or (state.connected and (state.queue or state.lost))
        return [*ready_actors, "worker"] if state.worker or waits else ready_actors

    def step(self, state: State, actor: str) -> State:
        """Return the state after an actor's next step."""
        after = self._work(state) if actor == "worker" else self._act(state, actor)
        moving = after.moving
        if (
            moving is not None
            and not after.returned_stops <= moving.stops
            and after.violation is None
        ):
            after = after._replace(
                violation="a request from before a stop moves after the stop has returned"
            )
        return after

    def next_step(self, state: State, actor: str) -> str:
        """Return the name of an actor's next step; "" at its end."""
        if actor == "worker":
            return self._plan(state)[0]
        index = self.actors.index(actor)
        return "".join(self.programs[index][state.at[index] : state.at[index] + 1])

    def walk(self) -> Walk:
        """Take every possible step from every reachable state."""
        result = Walk()
        known_states = {self.initial_state}
        pending: list[tuple[State, Trace]] = [(self.initial_state, ())]
        while pending:
            state, trace = pending.pop()
            new = False
            for actor in self.find_ready_actors(state) if state.violation is None else ():
                after = self.step(state, actor)
                if after not in known_states:
                    known_states.add(after)
                    pending.append((after, (*trace, actor)))
                    new = True
            if state.violation is not None:
                result.faults.setdefault(state.violation, trace)
            elif not new:
                result.traces.append(trace)
        return replace(result, states=len(known_states))

    def _passes(self, state: State, request: Request, *, writes: bool = False) -> bool:
        permit = request.permit
        assert permit is not None
        if writes and self.flaw == "the gate is checked only before the write":
            return True
        latched = state.latched and self.flaw != "a latch is not checked"
        late = request.kind == "speed" and state.lease_over
        if writes and self.flaw == "a lease is checked only before the write":
            late = False
        exchanged = state.session_driver != state.worker_driver
        return not (permit != state.counts or latched or late or exchanged or not state.connected)

    def _shut(self, state: State, *, latch: bool = False) -> State:
        counts = state.counts._replace(stops=state.counts.stops + 1)
        return state._replace(counts=counts, latched=state.latched or latch)

    def _reconnected(self, state: State) -> State:
        if self.flaw == "a connection is not counted":
            return state
        counts = state.counts._replace(connections=state.counts.connections + 1)
        return state._replace(counts=counts)

    def _act(self, state: State, actor: str) -> State:
        index = self.actors.index(actor)
        step = self.programs[index][state.at[index]]
        state = state._replace(at=_with(state.at, index, state.at[index] + 1))
        if step in ("draw", "check", "pass", "queue"):
            return self._ask(state, index, step)
        if step in ("shut", "drop", "look", "halt", "return"):
            return self._halt(state, index, step)
        if step == "release":
            counts = state.counts._replace(releases=state.counts.releases + 1)
            return state._replace(counts=counts, latched=False)
        if step == "connection own":
            if actor == "reconnect" and state.connected:
                return state
            return state._replace(connection_request=state.session_driver)
        if step == "connection nothing":
            return state._replace(connection_request="nothing")
        if step == "exchange":
            return state._replace(session_driver="b")
        if step == "reconnected":
            return self._reconnected(state)
        return state._replace(lost=True) if step == "lose" else state._replace(lease_over=True)

    def _ask(self, state: State, index: int, step: str) -> State:
        request = state.requests[index]
        if step == self.programs[index][0]:
            request = request._replace(stops=state.begun_stops, opening=state.opening)
        if step == "draw":
            request = request._replace(permit=state.counts)
        state = state._replace(requests=_with(state.requests, index, request))
        exchanged = state.session_driver != state.worker_driver
        refused = {
            "check": (state.latched and self.flaw != "a latch is not checked")
            or exchanged
            or not state.connected,
            "pass": step == "pass" and not self._passes(state, request),
        }
        if refused.get(step):
            return state._replace(at=_with(state.at, index, len(self.programs[index])))
        return state._replace(queue=(*state.queue, request)) if step == "queue" else state

    def _halt(self, state: State, index: int, step: str) -> State:
        actor = self.actors[index]
        if step == self.programs[index][0]:
            state = state._replace(begun_stops=state.begun_stops | {actor})
        if step == "shut":
            return self._shut(state, latch=actor == "emergency")
        if step == "drop":
            return state._replace(queue=())
        if step == "look":
            drivers = (state.worker_driver, state.session_driver)
            if self.flaw == "a stop reaches only one driver":
                drivers = (state.session_driver, state.session_driver)
            return state._replace(drivers_to_halt=_with(state.drivers_to_halt, index, drivers))
        if step == "halt":
            driver, *remaining = state.drivers_to_halt[index]
            state = state._replace(
                drivers_to_halt=_with(state.drivers_to_halt, index, tuple(remaining))
            )
            return _halted(state, driver)
        return state._replace(returned_stops=state.returned_stops | {actor})

    def _plan(self, state: State) -> tuple[str, ...]:
        """Return the worker's next steps: the rest of its current job, or a pending one."""
        if state.worker:
            return state.worker
        if state.connection_request is not None:
            return ("take connection",)
        return ("take", "hand over", "write") if state.queue else ("fail", *DISCONNECT_STEPS)

    def _work(self, state: State) -> State:
        step, *remaining = self._plan(state)
        state = state._replace(worker=tuple(remaining))
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
        return self._connect(state, step, remaining)

    def _connect(self, state: State, step: str, remaining: list[str]) -> State:
        if step == "drop":
            return state._replace(queue=(), current_request=None)
        if step == "halt own":
            return _halted(state, state.worker_driver)
        if step == "close":
            return state._replace(open=None, moving=None, connected=False)
        if step == "exchange":
            return state._replace(worker_driver=remaining[0], worker=tuple(remaining[1:]))
        if step == "open":
            return state._replace(open=state.worker_driver, opening=state.opening + 1, lost=False)
        return state._replace(connected=True) if step == "connected" else state

    def _take_connection(self, state: State) -> State:
        requested, steps = state.connection_request, ()
        if requested != state.worker_driver:
            steps = DISCONNECT_STEPS
        if requested not in (state.worker_driver, "nothing"):
            steps = (*steps, "exchange", str(requested), *CONNECT_STEPS)
        elif requested == state.worker_driver and not state.connected:
            steps = CONNECT_STEPS
        return state._replace(connection_request=None, worker=steps)

    def _take(self, state: State) -> State:
        # A stop has dropped the queue in the meantime.
        if not state.queue:
            return state._replace(worker=())
        request, *queue = state.queue
        if self.flaw == "the permit is stamped when it is taken":
            request = request._replace(permit=state.counts)
        return state._replace(current_request=request, queue=tuple(queue))

    def _hand_over(self, state: State, *, writes: bool) -> State:
        request = state.current_request
        if request is None or not self._passes(state, request, writes=writes):
            return state._replace(current_request=None, worker=())
        return self._written(state._replace(current_request=None), request) if writes else state

    def _written(self, state: State, request: Request) -> State:
        violation = None
        if not state.returned_stops <= request.stops:
            violation = "a request from before a stop is written after the stop has returned"
        elif state.latched:
            violation = "a request is written while a stop is latched"
        elif request.opening != state.opening or state.open is None:
            violation = "a request to an earlier connection is written"
        elif request.kind == "speed" and state.lease_over:
            violation = "a speed is written after its lease has run out"
        moving = state.moving if request.kind == "clear" else request
        return state._replace(moving=moving, violation=violation)


def _with(values, index, value):
    return (*values[:index], value, *values[index + 1 :])


def _halted(state: State, driver: str) -> State:
    return state._replace(moving=None) if state.open == driver else state
