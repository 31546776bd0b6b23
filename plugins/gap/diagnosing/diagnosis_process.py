"""Runs diagnoses in a separate process, so that they never hold the window's interpreter lock.

Messages between the two processes are pickled and sent through private pipes.
"""

import copyreg
import os
import pickle
import subprocess
import sys
import threading
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from io import BytesIO
from pathlib import Path
from queue import Empty, SimpleQueue
from types import MappingProxyType
from typing import IO

from rotemina.plugins.gap import mark, tr
from rotemina.plugins.gap.answer import DiagnosisAnswer
from rotemina.sim.errors import InputError
from rotemina.sim.gap.result import Listener, Progress
from rotemina.sim.records import Record
from rotemina.sim.robot import Robot

_PROCESS_ENDED = mark(
    "the process of the diagnosis ended (status {status}) without an answer, "
    "perhaps for lack of memory; diagnose again with fewer or shorter records"
)
_WORKER_ARGUMENTS = ("-m", "rotemina.plugins.gap.diagnosing.diagnosis_worker")

# The nice value of the process is this much higher than the window's.
_NICE_INCREMENT = 10

# Interval at which the caller checks for a cancellation while it waits for a message.
_CANCEL_CHECK_S = 0.05

# A process that does not end its work within this time is killed.
_END_TIMEOUT_S = 2.0


class DiagnosisError(RuntimeError):
    """Programming error in the diagnosis process."""


@dataclass(frozen=True, slots=True)
class DiagnosisRequest:
    """Request to diagnose records, which have the given names."""

    number: int
    robot: Robot
    names: tuple[str, ...]
    records: tuple[Record, ...]


@dataclass(frozen=True, slots=True)
class DiagnosisCancellation:
    """Cancellation of the request with this number, and of all earlier ones."""

    number: int


@dataclass(frozen=True, slots=True)
class DiagnosisFailure:
    """Reason why there is no answer, with a traceback if it is a programming error."""

    reason: str
    trace: str = ""


class DiagnosisProcess:
    """Process that diagnoses records. It starts at the first request and serves later ones too."""

    def __init__(self) -> None:
        self._process: subprocess.Popen[bytes] | None = None
        # The process whose priority was lowered permanently.
        self._low_priority_process: subprocess.Popen[bytes] | None = None
        self._messages: SimpleQueue[object] = SimpleQueue()
        self._request_number = 0

    def diagnose(
        self, robot: Robot, names: Sequence[str], records: Sequence[Record], listener: Listener
    ) -> DiagnosisAnswer:
        """Diagnose records, and compute the signals and maps to be drawn.

        Call this from one thread at a time. The listener is called after every step, and repeatedly
        with the latest step while it continues. An exception that the listener raises ends the
        diagnosis and is raised here.

        Raises
        ------
        InputError
            If the records cannot be diagnosed, or the process ends before it answers.
        DiagnosisError
            If there is a programming error.
        """
        self._request_number += 1
        request = DiagnosisRequest(self._request_number, robot, tuple(names), tuple(records))
        # This may fail, and then the process has nothing to cancel.
        data = _pickle_message(request)
        try:
            stream = self._ensure_started().stdin
            assert stream is not None
            stream.write(data)
            stream.flush()
            reply = self._wait_for_reply(listener)
        except (EOFError, OSError):
            raise InputError(tr(_PROCESS_ENDED).format(status=self.close())) from None
        except BaseException:
            self._interrupt()
            raise
        if isinstance(reply, DiagnosisAnswer):
            return replace(reply, records=tuple(records))
        if not reply.trace:
            raise InputError(reply.reason)
        error = DiagnosisError(reply.reason)
        # So the log also shows the traceback of the other process.
        error.add_note(reply.trace)
        raise error

    def lower_priority(self) -> None:
        """Let the process run only while no other process needs the core.

        While a machine moves, the window and the machine control must get the cores first. On
        Linux a nice value does not achieve this: a thread that wakes up preempts a process with the
        idle policy at once, but must wait for a process that only has a high nice value. A process
        cannot leave the idle policy without privileges, so the next request starts a new process.
        """
        process = self._process
        if (
            process is None
            or process is self._low_priority_process
            or not hasattr(os, "SCHED_IDLE")
        ):
            return
        self._low_priority_process = process
        # The process may have ended.
        with suppress(OSError):
            for thread in Path(f"/proc/{process.pid}/task").iterdir():
                # The thread may have ended, or the call may not be permitted.
                with suppress(OSError):
                    os.sched_setscheduler(int(thread.name), os.SCHED_IDLE, os.sched_param(0))

    def close(self) -> int | None:
        """End the process and return its exit status, or None if there is no process."""
        process, self._process = self._process, None
        if process is None:
            return None
        assert process.stdin is not None
        assert process.stdout is not None
        # Closing flushes the remaining data, and the process may no longer read them.
        with suppress(OSError):
            process.stdin.close()
        try:
            status = process.wait(_END_TIMEOUT_S)
        except subprocess.TimeoutExpired:
            process.kill()
            status = process.wait()
        return status

    def _wait_for_reply(self, listener: Listener) -> DiagnosisAnswer | DiagnosisFailure:
        latest = Progress("reading", None, None, 0.0)
        while True:
            listener(latest)
            try:
                message = self._messages.get(timeout=_CANCEL_CHECK_S)
            except Empty:
                continue
            if isinstance(message, Progress):
                latest = message
            elif isinstance(message, DiagnosisAnswer | DiagnosisFailure):
                return message
            else:
                raise EOFError

    def _ensure_started(self) -> subprocess.Popen[bytes]:
        """Return the process. Start a new one if it is missing, has ended or has low priority."""
        process = self._process
        if process is not None and (
            process is self._low_priority_process or process.poll() is not None
        ):
            self.close()
        if self._process is None:
            self._messages = SimpleQueue()
            self._process = _start_low_priority([sys.executable, *_WORKER_ARGUMENTS])
            threading.Thread(
                target=_forward_messages,
                args=(self._process.stdout, self._messages),
                name="diagnosis",
                daemon=True,
            ).start()
        return self._process

    def _interrupt(self) -> None:
        """Cancel the request, and kill the process if it does not reach its next step soon."""
        process = self._process
        if process is None or process.stdin is None:
            return
        # The process may have ended, its input may be closed, or it may not answer in time.
        with suppress(OSError, ValueError, Empty):
            send_message(DiagnosisCancellation(self._request_number), process.stdin)
            while isinstance(self._messages.get(timeout=_END_TIMEOUT_S), Progress):
                pass
            return
        process.kill()
        self.close()


def _start_low_priority(command: Sequence[str]) -> subprocess.Popen[bytes]:
    """Start a process that mostly yields to other processes, but still gets some time."""
    process = subprocess.Popen(
        command,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        # Windows gives some time even to a starving process of this class.
        creationflags=getattr(subprocess, "IDLE_PRIORITY_CLASS", 0),
    )
    if hasattr(os, "setpriority"):
        # Changing the priority may not be permitted.
        with suppress(OSError):
            own_nice = os.getpriority(os.PRIO_PROCESS, 0)
            os.setpriority(os.PRIO_PROCESS, process.pid, own_nice + _NICE_INCREMENT)
    return process


def send_message(message: object, stream: IO[bytes]) -> None:
    """Pickle a message completely, and then send it.

    So nothing is sent of a message that cannot be pickled.
    """
    stream.write(_pickle_message(message))
    stream.flush()


def _pickle_message(message: object) -> memoryview:
    buffer = BytesIO()
    pickler = pickle.Pickler(buffer)
    pickler.dispatch_table = copyreg.dispatch_table | {MappingProxyType: _reduce_proxy}
    pickler.dump(message)
    return buffer.getbuffer()


def receive_messages(stream: IO[bytes]) -> Iterator[object]:
    """Yield the messages of a stream until it ends.

    Use this only for pipes of our own processes, because unpickling runs code.
    """
    with suppress(EOFError, OSError, pickle.UnpicklingError):
        while True:
            yield pickle.load(stream)  # noqa: S301 (the pipe is private to our own processes)


def _reduce_proxy(proxy: MappingProxyType[object, object]) -> tuple[object, tuple[object]]:
    return _restore_proxy, (dict(proxy),)


def _restore_proxy(mapping: dict[object, object]) -> MappingProxyType[object, object]:
    # Pickle needs a function with an importable name, which MappingProxyType does not have.
    return MappingProxyType(mapping)


def _forward_messages(stream: IO[bytes], messages: "SimpleQueue[object]") -> None:
    """Put the messages of the process into a queue, and None after the last one."""
    try:
        with stream:
            for message in receive_messages(stream):
                messages.put(message)
    finally:
        messages.put(None)
