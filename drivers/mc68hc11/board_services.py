"""Services of the driver: captures, profiles, display, inputs, parameters, line quality."""

from math import ceil

from rotemina.drivers.abilities import (
    AnalogInputs,
    CapturedSamples,
    CaptureRates,
    FastCapturer,
    LinkReporter,
    MotionProfile,
    ParameterDifference,
    ParameterStore,
    ProfileRunner,
    TextDisplay,
)
from rotemina.drivers.contract import (
    DeviceState,
    LimitError,
    LinkQuality,
    Permit,
    StateError,
    combine_link_quality,
)
from rotemina.drivers.mc68hc11.capturing import BoardCapture
from rotemina.drivers.mc68hc11.connection import BoardConnection
from rotemina.drivers.mc68hc11.dialogue import BoardRequest, RequestUrgency
from rotemina.drivers.mc68hc11.profile_upload import make_profile_messages
from rotemina.drivers.mc68hc11.protocol import (
    AXES_PER_BOARD,
    AbortProfile,
    BeginCapture,
    BoardAbility,
    ShowText,
    TriggerProfile,
)
from rotemina.sim.messages import format_rounded

_MAX_SAMPLES = _MAX_PERIOD_US = 0xFFFF
# Maximum reading of the 12-bit converter.
_INPUT_FULL_SCALE = 4095.0
_BUTTON_COUNT = 2


class BoardServices(
    BoardConnection,
    FastCapturer,
    ProfileRunner,
    AnalogInputs,
    TextDisplay,
    ParameterStore,
    LinkReporter,
):
    """Abilities of the boards other than motion."""

    @property
    def capture_rates(self) -> CaptureRates:
        """Rates that the boards have reported. They are 0 before the boards are opened."""
        rates = (
            [board.rates for board in self._session.boards if board.rates] if self._session else []
        )
        if not rates:
            return CaptureRates(0.0, 0.0, AXES_PER_BOARD, _MAX_SAMPLES)
        return CaptureRates(
            float(min(board_rates.capture_one for board_rates in rates)),
            float(min(board_rates.capture_three for board_rates in rates)),
            AXES_PER_BOARD,
            _MAX_SAMPLES,
        )

    @property
    def differences(self) -> tuple[ParameterDifference, ...]:
        """Differences between the boards' parameters and the robot file."""
        return self._session.parameter_check.differences if self._session is not None else ()

    def link_quality(self) -> LinkQuality:
        """Return the combined quality of all lines: the sums of counts, and the worst times."""
        session = self._session
        return (
            combine_link_quality([link.read_quality() for link in session.links])
            if session
            else LinkQuality()
        )

    def analog_inputs(self) -> tuple[tuple[float, ...], tuple[bool, ...]]:
        """Return the latest inputs of the first board with a joystick, or empty tuples."""
        for board in self._session.boards if self._session is not None else ():
            if board.has_ability(BoardAbility.JOYSTICK) and (inputs := board.inputs) is not None:
                buttons = tuple(bool(inputs.buttons >> bit & 1) for bit in range(_BUTTON_COUNT))
                return tuple(
                    reading / _INPUT_FULL_SCALE for reading in inputs.unpack_readings()
                ), buttons
        return (), ()

    def read_capture(self) -> CapturedSamples | None:
        """Return the captured samples since the last call."""
        session = self._session
        return session.capture.take() if session is not None and session.capture else None

    def _capture(self, axes: tuple[str, ...], rate_hz: float, count: int) -> None:
        session = self._open_session
        boards = {session.find_axis(axis)[0] for axis in axes}
        if len(boards) > 1:
            raise LimitError(
                "{name}: {names} are not all on one board", name=self.name, names=", ".join(axes)
            )
        board = boards.pop()
        period_us = ceil(1e6 / rate_hz * (1.0 - 1e-9))
        if period_us > _MAX_PERIOD_US:
            raise LimitError(
                "{name}: capture at {rate_hz} Hz: must be at least {most_period_us} Hz",
                name=self.name,
                rate_hz=rate_hz,
                most_period_us=format_rounded(1000000.0 / _MAX_PERIOD_US, 3),
            )
        to_device_time_s = (
            session.sample_assembler.to_device_time_s
            if board is session.boards[0]
            else session.second_board_to_device_time_s
        )
        if session.capture is not None:
            previous_board = session.capture.board
            previous_board.dialogue.ask(
                BoardRequest(message=BeginCapture(0, 0, 0), urgency=RequestUrgency.BACKGROUND)
            )
        telemetry_ms = session.period_ms
        if board.rates is not None and board.rates.telemetry_while_capturing:
            telemetry_ms = session.slow_telemetry(
                board, 1000 // board.rates.telemetry_while_capturing
            )
        capture = BoardCapture(board, axes, period_us, count, telemetry_ms, to_device_time_s)
        session.capture = capture
        board.dialogue.ask(
            BoardRequest(
                message=BeginCapture(capture.axis_mask, period_us, count),
                urgency=RequestUrgency.BACKGROUND,
                on_answer=lambda _, now_s: capture.note_acceptance(
                    board.clock.to_board_time_us(now_s)
                ),
                on_refusal=lambda _: capture.note_refusal(),
            )
        )
        self._serve()

    def _commanded(self, axis: str) -> float:
        board, board_axis = self._open_session.find_axis(axis)
        return board_axis.to_si(board.read_commands()[board_axis.number])

    def _upload(self, profile: MotionProfile, permit: Permit) -> None:
        self._prepare_action("accept a profile")
        board, axis = self._open_session.find_axis(profile.axis)
        if not board.has_ability(BoardAbility.PROFILE):
            raise StateError(
                "{name}: {where} cannot run profiles", name=self.name, where=board.where
            )
        assert board.rates is not None, "the board reported its rates when it was opened"
        for index, order in enumerate(make_profile_messages(profile, axis, board.rates.tick)):
            board.orders.queue_order(("profile", index), order, permit=permit)
        self._profile_board = board
        self._serve()

    def _trigger(self, permit: Permit) -> None:
        self._handle_stop(self._open_session)
        if self._profile_board is None:
            raise StateError("{name}: there is no profile to run; upload one first", name=self.name)
        orders = self._profile_board.orders
        orders.queue_order("trigger", TriggerProfile(), DeviceState.PLAYING, permit=permit)
        self._profile_board = None
        self._serve()

    def _abort(self) -> None:
        self._handle_stop(self._open_session)
        self._profile_board = None
        for board in self._open_session.boards:
            if board.has_ability(BoardAbility.PROFILE):
                board.orders.drop_orders()
                board.orders.queue_order("abort", AbortProfile(), permit=None, halts=True)
        self._serve()

    def _show(self, row: int, text: str) -> None:
        for board in self._open_session.boards:
            if board.has_ability(BoardAbility.DISPLAY):
                text_message = ShowText(row, 0, text.encode("ascii", "replace"))
                board.dialogue.ask(
                    BoardRequest(message=text_message, urgency=RequestUrgency.BACKGROUND)
                )
                return self._serve()
        raise StateError("{name}: no board has a display", name=self.name)

    def _accept_parameters(self) -> None:
        self._open_session.parameter_check.accept_differences()

    def _write_parameters(self, permit: Permit) -> None:
        self._open_session.parameter_check.write_differences(permit)
        self._serve()
