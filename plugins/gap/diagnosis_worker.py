"""The process of the diagnosis: ``python -m …diagnosis_worker``; requests come by its input.

It ends when that is closed. What it tells goes through its output, which nothing else may use.
"""

import os
import signal
import sys
import threading
import traceback
from contextlib import suppress
from dataclasses import replace
from queue import SimpleQueue
from typing import IO

from rotemina.plugins.gap.diagnosis_answer import Answer
from rotemina.plugins.gap.diagnosis_process import Failure, Request, Unwanted, read, write
from rotemina.sim.errors import InputError
from rotemina.sim.gap.compare.diagnosis_progress import Progress


class _UnwantedError(Exception):
    """Nobody waits for the answer any more."""


class _Requests:
    """Reads requests, and which are wanted no more, on its own thread."""

    def __init__(self, stream: IO[bytes]) -> None:
        self.waiting: SimpleQueue[Request | None] = SimpleQueue()
        self.unwanted = 0  # requests up to this number
        threading.Thread(target=self._read, args=(stream,), daemon=True).start()

    def _read(self, stream: IO[bytes]) -> None:
        try:
            for message in read(stream):
                if isinstance(message, Unwanted):
                    self.unwanted = message.number
                elif isinstance(message, Request):
                    self.waiting.put(message)
        finally:
            self.unwanted = sys.maxsize  # nobody is there any more
            self.waiting.put(None)


def _reply(request: Request, requests: _Requests, out: IO[bytes]) -> Answer | Failure:
    latest: Progress | None = None
    guard = threading.Lock()  # steps come from any thread

    def listen(progress: Progress) -> None:
        nonlocal latest
        if requests.unwanted >= request.number:
            raise _UnwantedError
        with guard:
            if progress is not latest:  # which comes again before every simulation
                latest = progress
                write(progress, out)

    try:
        from rotemina.sim.gap import diagnosis_pipeline  # takes its time to import

        # One core stays free for the machine and the window.
        jobs = max((os.cpu_count() or 1) - 1, 1)
        diagnosis = diagnosis_pipeline.diagnose(
            request.robot, request.records, jobs=jobs, listener=listen
        )
        listen(Progress("drawing", None, None, 1.0))
        answer = Answer.of(diagnosis, request.names, request.records)
        return replace(answer, records=())  # which the other side has
    except _UnwantedError:
        return Failure("stopped")
    except InputError as error:
        return Failure(str(error))
    except Exception as error:  # whatever it is, the window says it
        return Failure(f"{type(error).__name__}: {error}", traceback.format_exc())


def main() -> int:
    """Answer requests until the input ends; return the exit status."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the window's, which ends this one
    out = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what a library prints goes elsewhere
    requests = _Requests(sys.stdin.buffer)
    with suppress(BrokenPipeError):  # whoever asked has gone
        while (request := requests.waiting.get()) is not None:
            write(_reply(request, requests, out), out)
    return 0


if __name__ == "__main__":
    sys.exit(main())
