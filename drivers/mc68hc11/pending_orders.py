"""Queue of orders for one board, which also predicts the board's state until telemetry shows it.

Of two orders for the same axis only the newer one is sent. After a stop by this host the board has
a fault. The queue clears this fault when the next order arrives and the board is at rest.
"""

from collections.abc import Callable, Hashable
from dataclasses import dataclass

from rotemina.drivers.contract import DeviceState, Permit
from rotemina.drivers.mc68hc11.board_clock import BoardClockEstimator
from rotemina.drivers.mc68hc11.dialogue import BoardDialogue, BoardRequest, RequestUrgency
from rotemina.drivers.mc68hc11.protocol import (
    BoardFault,
    BoardState,
    ClearFault,
    RefusalReason,
    StopBoard,
    Telemetry,
    WireMessage,
)
from rotemina.sim.messages import marked, message

_REFUSAL_TEXTS = {
    RefusalReason.UNKNOWN_TYPE: marked("engine", "it does not know this message"),
    RefusalReason.WRONG_LENGTH: marked("engine", "it expects another length of this message"),
    RefusalReason.BAD_VALUE: marked(
        "engine", "a value is outside the range that it accepts; compare its parameters"
    ),
    RefusalReason.NOT_HOMED: marked("engine", "it is not homed"),
    RefusalReason.BUSY: marked("engine", "it is busy"),
    RefusalReason.QUEUE_FULL: marked("engine", "its queue is full"),
    RefusalReason.NOT_ABLE: marked("engine", "it cannot do this"),
    RefusalReason.OUT_OF_ORDER: marked("engine", "it came out of order"),
}


@dataclass(slots=True)
class _PendingOrder:
    # The message, or a function that makes it, given the host time at which it is sent, s.
    message: WireMessage | Callable[[float], WireMessage]
    expected_state: DeviceState
    expires_s: float
    permit: Permit | None
    is_halt_only: bool


class PendingOrders:
    """Queue of the orders for one board.

    Parameters
    ----------
    address : int
    clock : BoardClockEstimator
        Estimate of the board's clock.
    get_telemetry : callable
        Return the latest telemetry of the board.

    Attributes
    ----------
    refusal : str or None
        Reason why the board refused an order. Not set if the board refused it because of a
        fault, since telemetry reports the fault.
    """

    dialogue: BoardDialogue

    def __init__(
        self,
        address: int,
        clock: BoardClockEstimator,
        get_telemetry: Callable[[], Telemetry | None],
    ) -> None:
        self.refusal: str | None = None
        self._address = address
        self._clock = clock
        self._get_telemetry = get_telemetry
        self._pending: dict[Hashable, _PendingOrder] = {}
        self._expected_state = DeviceState.MOVING
        # Board time of the latest executed order, until newer telemetry arrives.
        self._unconfirmed_us: int | None = None
        # Whether this host stopped the board and has not cleared the fault yet.
        self._is_stopped = False
        self._is_clearing = False
        # Board time at which a fault was cleared, until newer telemetry arrives. Older telemetry
        # still reports the fault.
        self._cleared_us: int | None = None

    @property
    def expected_state(self) -> DeviceState | None:
        """State that the orders will cause, or None if telemetry already shows their effect."""
        if self.dialogue.has_request(RequestUrgency.STOP):
            return DeviceState.MOVING
        if self._pending:
            return next(reversed(self._pending.values())).expected_state
        if self.dialogue.has_request(RequestUrgency.COMMAND) or self._unconfirmed_us is not None:
            return self._expected_state
        return None

    def is_expected_fault(self, fault: BoardFault) -> bool:
        """Return whether a stop by this host caused a reported fault, or it was just cleared."""
        if self._is_clearing or self._cleared_us is not None:
            return True
        return fault is BoardFault.STOPPED and self._is_stopped

    def queue_order(
        self,
        key: Hashable,
        message: WireMessage | Callable[[float], WireMessage],
        expected_state: DeviceState = DeviceState.MOVING,
        *,
        expires_s: float = float("inf"),
        permit: Permit | None,
        halts: bool = False,
    ) -> None:
        """Queue an order. It replaces an earlier one with the same key that was not sent yet.

        Parameters
        ----------
        key : hashable
            Identifies what the order is for, such as an axis.
        message : WireMessage or callable
            The message, or a function that makes it, given the host time at which it is sent, s.
        expected_state : DeviceState
            State of the board after it has received the order.
        expires_s : float
            Host time after which the order is dropped.
        permit : Permit or None
            Permit of a motion. An order that only halts needs none.
        halts : bool
            Whether the order only halts axes. It is not sent to a board that a stop has halted.
        """
        self._pending[key] = _PendingOrder(message, expected_state, expires_s, permit, halts)

    def stop(self) -> None:
        """Drop all orders, including the current one, and send stop until it is acknowledged."""
        self._pending.clear()
        self._is_clearing = False
        self._is_stopped = True
        self._expected_state = DeviceState.MOVING
        self.dialogue.cancel_requests()
        if not self.dialogue.has_request(RequestUrgency.STOP):
            self.dialogue.ask(
                BoardRequest(
                    message=StopBoard(),
                    urgency=RequestUrgency.STOP,
                    on_answer=self._note_done,
                    # A board that refuses the stop has received it. Telemetry shows the effect.
                    on_refusal=lambda _: self._note_done(StopBoard(), None),
                )
            )

    def drop_orders(self) -> None:
        """Drop the orders that were not sent yet, and reset the refusal."""
        self._pending.clear()
        self.refusal = None

    def clear_fault(self, permit: Permit) -> None:
        """Drop the orders and clear the fault of the board."""
        self.drop_orders()
        if not self._is_clearing:
            self._send_clear_fault(permit)

    def send_next(self, now_s: float) -> None:
        """Send the next order if the board is ready for it."""
        if self.dialogue.has_request(RequestUrgency.STOP) or self.dialogue.has_request(
            RequestUrgency.COMMAND
        ):
            return
        telemetry = self._get_telemetry()
        if not self._pending or telemetry is None:
            return
        key, order = next(iter(self._pending.items()))
        if self._is_stopped and order.is_halt_only:
            # The board has already halted, so there is no need to clear its stop.
            del self._pending[key]
            return
        if self._is_stopped and not self._is_released(telemetry, order.permit):
            return
        del self._pending[key]
        if now_s >= order.expires_s:
            return
        self._expected_state = order.expected_state
        self.dialogue.ask(
            BoardRequest(
                message=order.message(now_s) if callable(order.message) else order.message,
                on_answer=self._note_done,
                on_refusal=self._note_refusal,
                expires_s=order.expires_s,
                permit=order.permit,
            )
        )

    def note_telemetry(self, time_us: int) -> None:
        """Update the expected state after telemetry with this unwrapped board time has arrived."""
        if self._unconfirmed_us is not None and time_us > self._unconfirmed_us:
            self._unconfirmed_us = None
        if self._cleared_us is not None and time_us > self._cleared_us:
            self._cleared_us = None

    def _is_released(self, telemetry: Telemetry, permit: Permit | None) -> bool:
        """Return whether the stop by this host no longer holds the board.

        As soon as the board is at rest, its fault is cleared with the permit of the waiting order.
        That permit was issued after the stop.
        """
        if self._unconfirmed_us is not None or telemetry.state & BoardState.MOVING:
            return False
        if telemetry.fault == BoardFault.STOPPED:
            self._send_clear_fault(permit)
            return False
        self._is_stopped = False
        if telemetry.fault != BoardFault.NONE:
            # The board has another fault, which the operator must deal with.
            self._pending.clear()
            return False
        return True

    def _send_clear_fault(self, permit: Permit | None) -> None:
        self._is_clearing = True
        self._expected_state = DeviceState.MOVING
        self.dialogue.ask(
            BoardRequest(
                message=ClearFault(),
                on_answer=self._note_cleared,
                on_refusal=self._note_clear_failure,
                permit=permit,
            )
        )

    def _note_cleared(self, _answer: WireMessage, now_s: float) -> None:
        self._is_clearing = self._is_stopped = False
        self._unconfirmed_us = self._cleared_us = self._clock.to_board_time_us(now_s)

    def _note_clear_failure(self, _reason: int | None) -> None:
        # Only newer telemetry shows whether the fault still exists.
        self._is_clearing = False
        telemetry = self._get_telemetry()
        self._unconfirmed_us = (
            self._clock.unwrap(telemetry.time_us) if telemetry is not None else None
        )

    def _note_done(self, _answer: WireMessage, now_s: float | None) -> None:
        telemetry = self._get_telemetry()
        if now_s is not None and self._clock.is_known:
            self._unconfirmed_us = self._clock.to_board_time_us(now_s)
        elif telemetry is not None:
            self._unconfirmed_us = self._clock.unwrap(telemetry.time_us)

    def _note_refusal(self, reason: int | None) -> None:
        if reason is None:
            # The order expired before the board received it.
            return
        self._pending.clear()
        if reason != RefusalReason.FAULTY:
            reason_text = (
                _REFUSAL_TEXTS.get(RefusalReason(reason))
                if reason in tuple(RefusalReason)
                else None
            )
            self.refusal = message(
                "engine", "board {address} refused a motion: {why}; nothing more was sent to it"
            ).fill(
                address=self._address,
                why=reason_text or message("engine", "reason {number}").fill(number=reason),
            )
