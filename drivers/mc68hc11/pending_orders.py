"""What one board has yet to be told to do, and what is not known of it until it has been seen.

Of two orders for the same axis only the newer one is said. After a stop of the host's own, the
board holds a fault until it is cleared: that is done here, once it rests and the next order comes.
"""

from collections.abc import Callable, Hashable
from dataclasses import dataclass

from rotemina.drivers.gate import Permit
from rotemina.drivers.mc68hc11.board_clock import BoardClock
from rotemina.drivers.mc68hc11.board_messages import Telemetry
from rotemina.drivers.mc68hc11.dialogue import Dialogue, Request, Urgency
from rotemina.drivers.mc68hc11.host_messages import ClearFault, Stop
from rotemina.drivers.mc68hc11.payload import Message
from rotemina.drivers.mc68hc11.protocol_codes import Fault, Refusal, State
from rotemina.drivers.samples import DeviceState
from rotemina.sim.messages import marked, message

_REASONS = {
    Refusal.UNKNOWN_TYPE: marked("engine", "it does not know this message"),
    Refusal.WRONG_LENGTH: marked("engine", "it expects another length of this message"),
    Refusal.BAD_VALUE: marked(
        "engine", "a value is outside the range that it accepts; compare its parameters"
    ),
    Refusal.NOT_HOMED: marked("engine", "it is not homed"),
    Refusal.BUSY: marked("engine", "it is busy"),
    Refusal.QUEUE_FULL: marked("engine", "its queue is full"),
    Refusal.NOT_ABLE: marked("engine", "it cannot do this"),
    Refusal.OUT_OF_ORDER: marked("engine", "it came out of order"),
}


@dataclass(slots=True)
class _Order:
    what: Message | Callable[[float], Message]
    expected: DeviceState
    expires_s: float
    permit: Permit | None
    halts: bool


class Orders:
    """The orders for one board.

    Parameters
    ----------
    address : int
    clock : BoardClock
        The board's.
    told : callable
        Return its latest telemetry.

    Attributes
    ----------
    refusal : str or None
        Why the board refused an order, other than for a fault, which it tells by itself.
    """

    dialogue: Dialogue

    def __init__(
        self, address: int, clock: BoardClock, told: Callable[[], Telemetry | None]
    ) -> None:
        self.refusal: str | None = None
        self._address = address
        self._clock = clock
        self._told = told
        self._pending: dict[Hashable, _Order] = {}
        self._expected = DeviceState.MOVING
        self._unseen_us: int | None = None  # what it did at this time no telemetry has shown yet
        self._stopped = False  # by this host, and not cleared yet
        self._clearing = False
        self._cleared_us: int | None = None  # telemetry before still tells of the fault

    @property
    def expected(self) -> DeviceState | None:
        """What the board does, or will do, by what it was told; None where its telemetry knows."""
        if self.dialogue.has(Urgency.STOP):
            return DeviceState.MOVING
        if self._pending:
            return next(reversed(self._pending.values())).expected
        if self.dialogue.has(Urgency.COMMAND) or self._unseen_us is not None:
            return self._expected
        return None

    def explains(self, fault: Fault) -> bool:
        """Whether a fault that the board tells is none: a stop of the host's, or just cleared."""
        if self._clearing or self._cleared_us is not None:
            return True
        return fault is Fault.STOPPED and self._stopped

    def give(
        self,
        key: Hashable,
        what: Message | Callable[[float], Message],
        expected: DeviceState = DeviceState.MOVING,
        *,
        expires_s: float = float("inf"),
        permit: Permit | None,
        halts: bool = False,
    ) -> None:
        """Queue an order, in place of an earlier one with the same key that was not said yet.

        ``what`` is a message, or returns it at the host time when it is said. What only ``halts``
        may do without a permit, and is not said to a board that a stop has halted.
        """
        self._pending[key] = _Order(what, expected, expires_s, permit, halts)

    def stop(self) -> None:
        """Forget all orders, also what is under way, and say stop until it is acknowledged."""
        self._pending.clear()
        self._clearing = False
        self._stopped = True
        self._expected = DeviceState.MOVING
        self.dialogue.drop()
        if not self.dialogue.has(Urgency.STOP):
            self.dialogue.ask(
                Request(
                    message=Stop(),
                    urgency=Urgency.STOP,
                    answered=self._done,
                    # Whatever it refuses, it heard; what it does then is seen in its telemetry.
                    refused=lambda _: self._done(Stop(), None),
                )
            )

    def forget(self) -> None:
        """Forget what was not said yet, and a refusal."""
        self._pending.clear()
        self.refusal = None

    def clear_fault(self, permit: Permit) -> None:
        """Tell the board to forget its fault."""
        self.forget()
        if not self._clearing:
            self._clear(permit)

    def pump(self, now_s: float) -> None:
        """Say the next order if the board is ready for it."""
        if self.dialogue.has(Urgency.STOP) or self.dialogue.has(Urgency.COMMAND):
            return
        told = self._told()
        if not self._pending or told is None:
            return
        key, order = next(iter(self._pending.items()))
        if self._stopped and order.halts:
            del self._pending[key]  # no stop is cleared for it
            return
        if self._stopped and not self._released(told, order.permit):
            return
        del self._pending[key]
        if now_s >= order.expires_s:
            return
        self._expected = order.expected
        self.dialogue.ask(
            Request(
                message=order.what(now_s) if callable(order.what) else order.what,
                answered=self._done,
                refused=self._refused,
                expires_s=order.expires_s,
                permit=order.permit,
            )
        )

    def seen(self, time_us: int) -> None:
        """Note that telemetry of this unwrapped time has come."""
        if self._unseen_us is not None and time_us > self._unseen_us:
            self._unseen_us = None
        if self._cleared_us is not None and time_us > self._cleared_us:
            self._cleared_us = None

    def _released(self, told: Telemetry, permit: Permit | None) -> bool:
        """Whether the host's own stop no longer holds the board.

        It is cleared as soon as the board rests, by the permit of the order that waits: one that
        was drawn after the stop.
        """
        if self._unseen_us is not None or told.state & State.MOVING:
            return False
        if told.fault == Fault.STOPPED:
            self._clear(permit)
            return False
        self._stopped = False
        if told.fault != Fault.NONE:
            self._pending.clear()  # a fault of its own, which somebody has to look at
            return False
        return True

    def _clear(self, permit: Permit | None) -> None:
        self._clearing = True
        self._expected = DeviceState.MOVING
        self.dialogue.ask(
            Request(
                message=ClearFault(),
                answered=self._cleared,
                refused=self._not_cleared,
                permit=permit,
            )
        )

    def _cleared(self, _answer: Message, now_s: float) -> None:
        self._clearing = self._stopped = False
        self._unseen_us = self._cleared_us = self._clock.time_us(now_s)

    def _not_cleared(self, _reason: int | None) -> None:
        # It lasts: the next telemetry says whether it still does.
        self._clearing = False
        told = self._told()
        self._unseen_us = self._clock.unwrapped(told.time_us) if told is not None else None

    def _done(self, _answer: Message, now_s: float | None) -> None:
        told = self._told()
        if now_s is not None and self._clock.known:
            self._unseen_us = self._clock.time_us(now_s)
        elif told is not None:
            self._unseen_us = self._clock.unwrapped(told.time_us)

    def _refused(self, reason: int | None) -> None:
        if reason is None:
            return  # its time was over before the board heard it
        self._pending.clear()
        if reason != Refusal.FAULTY:
            why = _REASONS.get(Refusal(reason)) if reason in tuple(Refusal) else None
            self.refusal = message(
                "engine", "board {address} refused a motion: {why}; nothing more was sent to it"
            ).fill(
                address=self._address,
                why=why or message("engine", "reason {number}").fill(number=reason),
            )
