"""Entry point of the diagnosis process, ``python -m …diagnosis_worker``.

The process reads requests from its standard input, and ends when that is closed. It writes its
messages to its standard output, which nothing else may use.
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

from rotemina.plugins.gap.answer import DiagnosisAnswer
from rotemina.plugins.gap.diagnosing.diagnosis_process import (
    DiagnosisCancellation,
    DiagnosisFailure,
    DiagnosisRequest,
    receive_messages,
    send_message,
)
from rotemina.sim.errors import InputError
from rotemina.sim.gap.result import Progress


class _CancelledError(Exception):
    pass


class _RequestReader:
    def __init__(self, stream: IO[bytes]) -> None:
        self.queue: SimpleQueue[DiagnosisRequest | None] = SimpleQueue()
        # Requests up to this number are cancelled.
        self.cancelled_up_to = 0
        threading.Thread(target=self._read, args=(stream,), daemon=True).start()

    def _read(self, stream: IO[bytes]) -> None:
        try:
            for message in receive_messages(stream):
                if isinstance(message, DiagnosisCancellation):
                    self.cancelled_up_to = message.number
                elif isinstance(message, DiagnosisRequest):
                    self.queue.put(message)
        finally:
            # The window has closed, so nobody waits for an answer any more.
            self.cancelled_up_to = sys.maxsize
            self.queue.put(None)


def _answer_request(
    request: DiagnosisRequest, requests: _RequestReader, out: IO[bytes]
) -> DiagnosisAnswer | DiagnosisFailure:
    latest: Progress | None = None
    # The lock is needed because the listener is called from several threads.
    lock = threading.Lock()

    def listen(progress: Progress) -> None:
        nonlocal latest
        if requests.cancelled_up_to >= request.number:
            raise _CancelledError
        with lock:
            # The same step is reported repeatedly, before each simulation.
            if progress is not latest:
                latest = progress
                send_message(progress, out)

    try:
        # The pipeline is imported only here, because that is slow.
        from rotemina.sim.gap.pipeline import diagnosis_pipeline

        # One core stays free for the machine and the window.
        jobs = max((os.cpu_count() or 1) - 1, 1)
        diagnosis = diagnosis_pipeline.diagnose(
            request.robot, request.records, jobs=jobs, listener=listen
        )
        listen(Progress("drawing", None, None, 1.0))
        answer = DiagnosisAnswer.from_diagnosis(diagnosis, request.names, request.records)
        # The window has the records already.
        return replace(answer, records=())
    except _CancelledError:
        return DiagnosisFailure("stopped")
    except InputError as error:
        return DiagnosisFailure(str(error))
    # Every error is caught, because the window shows it.
    except Exception as error:
        return DiagnosisFailure(f"{type(error).__name__}: {error}", traceback.format_exc())


def main() -> int:
    """Answer requests until the input ends, and return the exit status."""
    # Ctrl-C is meant for the window, which then ends this process.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    out = os.fdopen(os.dup(1), "wb")
    # Text that a library prints goes to standard error, so that it does not mix with the messages.
    os.dup2(2, 1)
    requests = _RequestReader(sys.stdin.buffer)
    # The window may have closed before the answer is written.
    with suppress(BrokenPipeError):
        while (request := requests.queue.get()) is not None:
            send_message(_answer_request(request, requests, out), out)
    return 0


if __name__ == "__main__":
    sys.exit(main())
