"""Progress of long work on stderr: a line that is rewritten, or a new line every few seconds."""

import shutil
import time
from collections.abc import Callable
from types import TracebackType
from typing import Self, TextIO

from rotemina.sim.gap.result import Progress
from rotemina.sim.messages import MessageWording, NumberText, format_fixed, message

_REWRITE_PERIOD_S = 0.1
_LINE_PERIOD_S = 5.0
# The remaining time is estimated only after this time, and after this share of the work.
_MIN_ESTIMATE_TIME_S = 1.0
_MIN_ESTIMATE_SHARE = 0.02
_ERASE_TO_LINE_END = "\x1b[K"


class TerminalProgressLine:
    """A listener that prints stage, axis, candidate, best candidate so far and remaining time.

    On a terminal it rewrites one line, which is completed when the context ends. Otherwise it
    prints a line every few seconds, so that a log stays short.
    """

    def __init__(
        self,
        stream: TextIO,
        wording: MessageWording | None = None,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._stream = stream
        self._wording = wording or MessageWording()
        self._clock = clock
        self._is_terminal = stream.isatty()
        self._start_s = clock()
        self._last_print_s = self._start_s
        self._is_line_open = False
        self._completed_share = 0.0

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._is_line_open:
            print(file=self._stream, flush=True)
            self._is_line_open = False

    def __call__(self, progress: Progress) -> None:
        """Print the progress, unless the last print was very recent."""
        self._completed_share = max(self._completed_share, progress.share)
        now_s = self._clock()
        min_pause_s = _REWRITE_PERIOD_S if self._is_terminal else _LINE_PERIOD_S
        has_printed_before = self._is_line_open or not self._is_terminal
        if has_printed_before and now_s - self._last_print_s < min_pause_s:
            return
        self._last_print_s = now_s
        text = self._make_text(progress, now_s - self._start_s)
        if self._is_terminal:
            width = shutil.get_terminal_size().columns
            print(
                f"\r{text[: width - 1]}{_ERASE_TO_LINE_END}", end="", file=self._stream, flush=True
            )
            self._is_line_open = True
        else:
            print(text, file=self._stream, flush=True)

    def _make_text(self, progress: Progress, elapsed_s: float) -> str:
        stage = self._wording.localize_text("gap", progress.stage)
        task_parts = (stage, progress.axis, self._wording.format_field(progress.candidate or ""))
        parts: list[str] = [
            " ".join(part for part in task_parts if part),
            NumberText(f"{format_fixed(100.0 * self._completed_share, 0)} %"),
        ]
        if progress.ranking is not None and progress.ranking.standings:
            leader = progress.ranking.standings[0]
            parts.append(
                message("cli", "{causes} first of {tried}: {closed} closed").fill(
                    causes=" + ".join(effect for effect, _ in leader.causes)
                    or message("cli", "re-tuned model"),
                    tried=progress.ranking.tried,
                    closed=NumberText(f"{format_fixed(100.0 * leader.closed, 0)} %"),
                )
            )
        if elapsed_s >= _MIN_ESTIMATE_TIME_S and self._completed_share >= _MIN_ESTIMATE_SHARE:
            remaining_s = elapsed_s * (1.0 / self._completed_share - 1.0)
            parts.append(
                message("cli", "about {duration} left").fill(duration=_format_duration(remaining_s))
            )
        return ", ".join(self._wording.format_field(part) for part in parts)


def _format_duration(seconds: float) -> NumberText:
    if seconds < 90.0:
        return NumberText(f"{format_fixed(seconds, 0)} s")
    if seconds < 5400.0:
        return NumberText(f"{format_fixed(seconds / 60.0, 0)} min")
    return NumberText(f"{format_fixed(seconds / 3600.0, 1)} h")
