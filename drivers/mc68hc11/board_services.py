"""What the driver does beside moving: captures, profiles, display, inputs, parameters, quality."""

from math import ceil

from rotemina.drivers.abilities import (
    AnalogInputs,
    Capturer,
    Display,
    Linked,
    Parameterised,
    ProfileRunner,
)
from rotemina.drivers.capture import Captured, CaptureRates
from rotemina.drivers.errors import LimitError, StateError
from rotemina.drivers.gate import Permit
from rotemina.drivers.line_quality import LinkQuality, total_quality
from rotemina.drivers.mc68hc11.capturing import Capturing
from rotemina.drivers.mc68hc11.connection import Connected
from rotemina.drivers.mc68hc11.dialogue import Request, Urgency
from rotemina.drivers.mc68hc11.host_messages import AbortProfile, Capture, ShowText, TriggerProfile
from rotemina.drivers.mc68hc11.profile_upload import profile_messages
from rotemina.drivers.mc68hc11.protocol_codes import AXES, Ability
from rotemina.drivers.parameters import ParameterDifference
from rotemina.drivers.profile import Profile
from rotemina.drivers.samples import DeviceState
from rotemina.sim.messages import message
from rotemina.sim.quantities import rounded

_MOST_SAMPLES = _MOST_PERIOD_US = 0xFFFF
_FULL_SCALE = 4095.0  # of 12 bits
_BUTTONS = 2


class Extras(Connected, Capturer, ProfileRunner, AnalogInputs, Display, Parameterised, Linked):
    """The boards' other abilities."""

    @property
    def capture_rates(self) -> CaptureRates:
        """As the boards announced; (0, 0) before they were opened."""
        rates = [b.rates for b in self._session.boards if b.rates] if self._session else []
        if not rates:
            return CaptureRates(0.0, 0.0, AXES, _MOST_SAMPLES)
        return CaptureRates(
            float(min(one.capture_one for one in rates)),
            float(min(one.capture_three for one in rates)),
            AXES,
            _MOST_SAMPLES,
        )

    @property
    def differences(self) -> tuple[ParameterDifference, ...]:
        """Where the boards' parameters differ from the robot file."""
        return self._session.trust.differences if self._session is not None else ()

    def link_quality(self) -> LinkQuality:
        """Return the counts of all lines together, and the worst of their times."""
        session = self._session
        return (
            total_quality([link.quality() for link in session.links]) if session else LinkQuality()
        )

    def analog_inputs(self) -> tuple[tuple[float, ...], tuple[bool, ...]]:
        """Return what the first board with a joystick told last; nothing before it did."""
        for board in self._session.boards if self._session is not None else ():
            if board.able(Ability.JOYSTICK) and (inputs := board.inputs) is not None:
                buttons = tuple(bool(inputs.buttons >> bit & 1) for bit in range(_BUTTONS))
                return tuple(one / _FULL_SCALE for one in inputs.readings()), buttons
        return (), ()

    def captured(self) -> Captured | None:
        """Return what has come of the capture since the last call."""
        session = self._session
        return session.capturing.take() if session is not None and session.capturing else None

    def _capture(self, axes: tuple[str, ...], rate_hz: float, count: int) -> None:
        session = self._running
        boards = {session.board_of(axis)[0] for axis in axes}
        if len(boards) > 1:
            raise LimitError(
                message("engine", "{name}: {names} are not all on one board").fill(
                    name=self.name, names=", ".join(axes)
                )
            )
        board = boards.pop()
        period_us = ceil(1e6 / rate_hz * (1.0 - 1e-9))
        if period_us > _MOST_PERIOD_US:
            raise LimitError(
                message(
                    "engine",
                    "{name}: capture at {rate_hz} Hz: must be at least {most_period_us} Hz",
                ).fill(
                    name=self.name,
                    rate_hz=rate_hz,
                    most_period_us=rounded(1000000.0 / _MOST_PERIOD_US, 3),
                )
            )
        on_clock = session.sampling.time_s if board is session.boards[0] else session.second_time_s
        if session.capturing is not None:
            old = session.capturing.board
            old.dialogue.ask(Request(message=Capture(0, 0, 0), urgency=Urgency.BACKGROUND))
        telemetry_ms = session.period_ms
        if board.rates is not None and board.rates.telemetry_while_capturing:
            telemetry_ms = session.slow_down(board, 1000 // board.rates.telemetry_while_capturing)
        run = Capturing(board, axes, period_us, count, telemetry_ms, on_clock)
        session.capturing = run
        board.dialogue.ask(
            Request(
                message=Capture(run.mask, period_us, count),
                urgency=Urgency.BACKGROUND,
                answered=lambda _, now_s: run.granted(board.clock.time_us(now_s)),
                refused=lambda _: run.refused(),
            )
        )
        self._serve()

    def _commanded(self, axis: str) -> float:
        board, own = self._running.board_of(axis)
        return own.value(board.commanded()[own.number])

    def _upload(self, profile: Profile, permit: Permit) -> None:
        self._prepare("accept a profile")
        board, axis = self._running.board_of(profile.axis)
        if not board.able(Ability.PROFILE):
            raise StateError(
                message("engine", "{name}: {where} cannot run profiles").fill(
                    name=self.name, where=board.where
                )
            )
        assert board.rates is not None, "it announced them when it was opened"
        for index, order in enumerate(profile_messages(profile, axis, board.rates.tick)):
            board.orders.give(("profile", index), order, permit=permit)
        self._profile = board
        self._serve()

    def _trigger(self, permit: Permit) -> None:
        self._follow_stop(self._running)
        if self._profile is None:
            raise StateError(
                message("engine", "{name}: there is no profile to run; upload one first").fill(
                    name=self.name
                )
            )
        orders = self._profile.orders
        orders.give("trigger", TriggerProfile(), DeviceState.PLAYING, permit=permit)
        self._profile = None
        self._serve()

    def _abort(self) -> None:
        self._follow_stop(self._running)
        self._profile = None
        for board in self._running.boards:
            if board.able(Ability.PROFILE):
                board.orders.forget()
                board.orders.give("abort", AbortProfile(), permit=None, halts=True)
        self._serve()

    def _show(self, row: int, text: str) -> None:
        for board in self._running.boards:
            if board.able(Ability.DISPLAY):
                shown = ShowText(row, 0, text.encode("ascii", "replace"))
                board.dialogue.ask(Request(message=shown, urgency=Urgency.BACKGROUND))
                return self._serve()
        raise StateError(message("engine", "{name}: no board has a display").fill(name=self.name))

    def _accept_parameters(self) -> None:
        self._running.trust.accept()

    def _write_parameters(self, permit: Permit) -> None:
        self._running.trust.write(permit)
        self._serve()
