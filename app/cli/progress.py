"""Progress of long work on stderr: one line that is rewritten, or a line every few seconds."""

import shutil
import time
from collections.abc import Callable
from types import TracebackType
from typing import Self, TextIO

from rotemina.sim.gap.compare.diagnosis_progress import Progress
from rotemina.sim.messages import Wording, message
from rotemina.sim.quantities import Number, fixed

_BETWEEN_REWRITES_S = 0.1
_BETWEEN_LINES_S = 5.0
_FIRST_GUESS_S = 1.0  # before which nothing is said of the time left
_FIRST_GUESS_SHARE = 0.02
_TO_LINE_END = "\x1b[K"


class ProgressLine:
    """A listener that prints stage, axis, candidate, the leading candidate and the time left.

    On a terminal it rewrites one line and ends it when its context ends; elsewhere it writes a
    line every few seconds, so that a log stays short.
    """

    def __init__(
        self,
        stream: TextIO,
        wording: Wording | None = None,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._stream = stream
        self._wording = wording or Wording()
        self._clock = clock
        self._terminal = stream.isatty()
        self._begin_s = clock()
        self._last_s = self._begin_s
        self._open = False
        self._share = 0.0

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._open:
            print(file=self._stream, flush=True)
            self._open = False

    def __call__(self, progress: Progress) -> None:
        """Return how far it has come, unless that was just done."""
        self._share = max(self._share, progress.share)
        now_s = self._clock()
        pause_s = _BETWEEN_REWRITES_S if self._terminal else _BETWEEN_LINES_S
        begun = self._open or not self._terminal
        if begun and now_s - self._last_s < pause_s:
            return
        self._last_s = now_s
        text = self._text(progress, now_s - self._begin_s)
        if self._terminal:
            width = shutil.get_terminal_size().columns
            print(f"\r{text[: width - 1]}{_TO_LINE_END}", end="", file=self._stream, flush=True)
            self._open = True
        else:
            print(text, file=self._stream, flush=True)

    def _text(self, progress: Progress, elapsed_s: float) -> str:
        stage = self._wording.text("gap", progress.stage)
        what = (stage, progress.axis, self._wording.shown(progress.candidate or ""))
        parts: list[str] = [
            " ".join(part for part in what if part),
            Number(f"{fixed(100.0 * self._share, 0)} %"),
        ]
        if progress.ranking is not None and progress.ranking.standings:
            first = progress.ranking.standings[0]
            parts.append(
                message("cli", "{causes} first of {tried}: {closed} closed").fill(
                    causes=" + ".join(effect for effect, _ in first.causes)
                    or message("cli", "re-tuned model"),
                    tried=progress.ranking.tried,
                    closed=Number(f"{fixed(100.0 * first.closed, 0)} %"),
                )
            )
        if elapsed_s >= _FIRST_GUESS_S and self._share >= _FIRST_GUESS_SHARE:
            left_s = elapsed_s * (1.0 / self._share - 1.0)
            parts.append(message("cli", "about {duration} left").fill(duration=_duration(left_s)))
        return ", ".join(self._wording.shown(part) for part in parts)


def _duration(seconds: float) -> Number:
    if seconds < 90.0:
        return Number(f"{fixed(seconds, 0)} s")
    if seconds < 5400.0:
        return Number(f"{fixed(seconds / 60.0, 0)} min")
    return Number(f"{fixed(seconds / 3600.0, 1)} h")
