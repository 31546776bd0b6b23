"""Diagnoses in a process of their own: their work never holds the interpreter of the window.

What goes between the two is pickled, through pipes that nobody else has.
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
from rotemina.plugins.gap.diagnosis_answer import Answer
from rotemina.sim.errors import InputError
from rotemina.sim.gap.compare.diagnosis_progress import Listener, Progress
from rotemina.sim.records.record import Record
from rotemina.sim.robot.model import Robot

_ENDED = mark(
    "the process of the diagnosis ended (status {status}) without an answer, "
    "perhaps for lack of memory; diagnose again with fewer or shorter records"
)
_WORKER = ("-m", "rotemina.plugins.gap.diagnosis_worker")
_NICE = 10  # above the window's nice value
_LOOKS_S = 0.05  # between two questions whether an answer is still wanted
_PATIENCE_S = 2.0  # before a process that does not end its work is ended itself


class DiagnosisError(RuntimeError):
    """A fault of the program in the process of the diagnosis."""


@dataclass(frozen=True, slots=True)
class Request:
    """Records to be diagnosed, and what they are called."""

    number: int
    robot: Robot
    names: tuple[str, ...]
    records: tuple[Record, ...]


@dataclass(frozen=True, slots=True)
class Unwanted:
    """Cancels a request."""

    number: int


@dataclass(frozen=True, slots=True)
class Failure:
    """Why there is no answer; with a traceback where that is a fault of the program."""

    reason: str
    trace: str = ""


class DiagnosisProcess:
    """A process that diagnoses records; it starts with the first request and stays for others."""

    def __init__(self) -> None:
        self._process: subprocess.Popen[bytes] | None = None
        self._behind: subprocess.Popen[bytes] | None = None  # the process that stands back
        self._told: SimpleQueue[object] = SimpleQueue()
        self._number = 0

    def answer(
        self, robot: Robot, names: Sequence[str], records: Sequence[Record], listener: Listener
    ) -> Answer:
        """Diagnose records and work out what is drawn; from one thread at a time.

        The listener is told of every step, and the last one again and again: what it raises ends
        the diagnosis and is raised here.

        Raises
        ------
        InputError
            If the records cannot be diagnosed, or the process ends before it answers.
        DiagnosisError
            If the program is at fault.
        """
        self._number += 1
        try:
            request = Request(self._number, robot, tuple(names), tuple(records))
            stream = self._started().stdin
            assert stream is not None
            write(request, stream)
            told = self._reply(listener)
        except (EOFError, OSError):
            raise InputError(tr(_ENDED).format(status=self.close())) from None
        except BaseException:
            self._interrupt()
            raise
        if isinstance(told, Answer):
            return replace(told, records=tuple(records))
        if not told.trace:
            raise InputError(told.reason)
        error = DiagnosisError(told.reason)
        error.add_note(told.trace)  # for the log
        raise error

    def stand_back(self) -> None:
        """Let the process run only while no other wants the core, for as long as it lives.

        While a machine moves, the window and what steers it go first. A nice value is not enough
        on Linux: a thread that wakes takes a core from a process of this policy at once, but waits
        behind one that is only nice. A process cannot leave this policy without privileges, so the
        next request starts another one.
        """
        process = self._process
        if process is None or process is self._behind or not hasattr(os, "SCHED_IDLE"):
            return
        self._behind = process
        with suppress(OSError):  # it may have ended
            for thread in Path(f"/proc/{process.pid}/task").iterdir():
                with suppress(OSError):  # this one may have, or it is not allowed here
                    os.sched_setscheduler(int(thread.name), os.SCHED_IDLE, os.sched_param(0))

    def close(self) -> int | None:
        """End the process, if any, and return its status."""
        process, self._process = self._process, None
        if process is None:
            return None
        assert process.stdin is not None
        assert process.stdout is not None
        with suppress(OSError):  # of what was not written yet
            process.stdin.close()
        try:
            status = process.wait(_PATIENCE_S)
        except subprocess.TimeoutExpired:
            process.kill()
            status = process.wait()
        return status

    def _reply(self, listener: Listener) -> Answer | Failure:
        latest = Progress("reading", None, None, 0.0)
        while True:
            listener(latest)
            try:
                told = self._told.get(timeout=_LOOKS_S)
            except Empty:
                continue
            if isinstance(told, Progress):
                latest = told
            elif isinstance(told, Answer | Failure):
                return told
            else:
                raise EOFError

    def _started(self) -> subprocess.Popen[bytes]:
        """Return the process; another one where it has ended or stands back, or there is none."""
        process = self._process
        if process is not None and (process is self._behind or process.poll() is not None):
            self.close()
        if self._process is None:
            self._told = SimpleQueue()
            self._process = _in_background([sys.executable, *_WORKER])
            threading.Thread(
                target=_read_on,
                args=(self._process.stdout, self._told),
                name="diagnosis",
                daemon=True,
            ).start()
        return self._process

    def _interrupt(self) -> None:
        """Let the work end at its next step, or the process if that does not come soon."""
        process = self._process
        if process is None or process.stdin is None:
            return
        with suppress(OSError, ValueError, Empty):  # it has gone, its input is closed, or it works
            write(Unwanted(self._number), process.stdin)
            while isinstance(self._told.get(timeout=_PATIENCE_S), Progress):
                pass
            return
        process.kill()
        self.close()


def _in_background(command: Sequence[str]) -> subprocess.Popen[bytes]:
    """Start a process that leaves others the larger share, but is never kept from the cores."""
    process = subprocess.Popen(
        command,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        creationflags=getattr(subprocess, "IDLE_PRIORITY_CLASS", 0),  # Windows lifts what starves
    )
    if hasattr(os, "setpriority"):
        with suppress(OSError):  # it may not be allowed here
            own = os.getpriority(os.PRIO_PROCESS, 0)
            os.setpriority(os.PRIO_PROCESS, process.pid, own + _NICE)
    return process


def write(message: object, stream: IO[bytes]) -> None:
    """Write a message down, and send it whole: nothing of what cannot be written."""
    written = BytesIO()
    pickler = pickle.Pickler(written)
    pickler.dispatch_table = copyreg.dispatch_table | {MappingProxyType: _thawed}
    pickler.dump(message)
    stream.write(written.getbuffer())
    stream.flush()


def read(stream: IO[bytes]) -> Iterator[object]:
    """Give the messages that come, until no more do; from our own processes alone."""
    with suppress(EOFError, OSError, pickle.UnpicklingError):
        while True:
            yield pickle.load(stream)  # noqa: S301 (our own)


def _thawed(proxy: MappingProxyType[object, object]) -> tuple[object, tuple[object]]:
    return _frozen, (dict(proxy),)


def _frozen(mapping: dict[object, object]) -> MappingProxyType[object, object]:
    return MappingProxyType(mapping)  # itself it has no name by which another process could call it


def _read_on(stream: IO[bytes], told: "SimpleQueue[object]") -> None:
    """Hand on what the process tells; None once it tells nothing any more."""
    try:
        with stream:
            for message in read(stream):
                told.put(message)
    finally:
        told.put(None)
