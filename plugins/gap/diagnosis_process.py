"""Diagnoses in a process of their own: their work never holds the interpreter of the window.

What goes between the two is pickled, through pipes that nobody else has.
"""

import copyreg
import pickle
import subprocess
import sys
import threading
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from queue import Empty, SimpleQueue
from types import MappingProxyType
from typing import IO

from rotemina.plugins.gap.answer import Answer
from rotemina.sim.errors import InputError
from rotemina.sim.gap.progress import Listener, Progress
from rotemina.sim.records.record import Record
from rotemina.sim.robot.model import Robot

_WORKER = ("-m", "rotemina.plugins.gap.diagnosis_worker")
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
    """Says that no answer to a request is wanted any more."""

    number: int


@dataclass(frozen=True, slots=True)
class Failure:
    """Why there is no answer: what is wrong with the request, or a fault with its traceback."""

    reason: str
    by_input: bool


class DiagnosisProcess:
    """A process that diagnoses records; it starts with the first request and stays for others."""

    def __init__(self) -> None:
        self._process: subprocess.Popen[bytes] | None = None
        self._told: SimpleQueue[object] = SimpleQueue()
        self._number = 0

    def answer(
        self,
        robot: Robot,
        names: Sequence[str],
        records: Sequence[Record],
        listener: Listener,
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
            self._send(Request(self._number, robot, tuple(names), tuple(records)))
            told = self._reply(listener)
        except (EOFError, OSError):
            raise InputError(
                f"the process of the diagnosis has ended (status {self.close()}) before it "
                "answered; is there memory enough? Diagnose again, with fewer or shorter records"
            ) from None
        except BaseException:
            self._interrupt()
            raise
        if isinstance(told, Answer):
            return replace(told, records=tuple(records))
        raise (InputError if told.by_input else DiagnosisError)(told.reason)

    def close(self) -> int | None:
        """End the process, if there is one, and return its status."""
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

    def _send(self, message: object) -> None:
        if self._process is not None and self._process.poll() is not None:
            self.close()
        if self._process is None:
            self._told = SimpleQueue()
            self._process = process = subprocess.Popen(
                [sys.executable, *_WORKER], stdin=subprocess.PIPE, stdout=subprocess.PIPE
            )
            threading.Thread(
                target=_read_on, args=(process.stdout, self._told), name="diagnosis", daemon=True
            ).start()
        assert self._process.stdin is not None
        write(message, self._process.stdin)

    def _interrupt(self) -> None:
        """Let the work end at its next step, or the process if that does not come soon."""
        with suppress(OSError, Empty):
            self._send(Unwanted(self._number))
            while isinstance(self._told.get(timeout=_PATIENCE_S), Progress):
                pass
            return
        if self._process is not None:
            self._process.kill()
        self.close()


def write(message: object, stream: IO[bytes]) -> None:
    """Write a message down, and send it."""
    pickler = pickle.Pickler(stream)
    pickler.dispatch_table = copyreg.dispatch_table | {MappingProxyType: _thawed}
    pickler.dump(message)
    stream.flush()


def _thawed(proxy: MappingProxyType[object, object]) -> tuple[object, tuple[object]]:
    return _frozen, (dict(proxy),)


def _frozen(mapping: dict[object, object]) -> MappingProxyType[object, object]:
    return MappingProxyType(mapping)  # itself it has no name by which another process could call it


def _read_on(stream: IO[bytes], told: "SimpleQueue[object]") -> None:
    """Hand on what the process tells; None once it tells nothing any more."""
    with stream:
        while True:
            try:
                message = pickle.load(stream)  # noqa: S301 (from our own process alone)
            except (EOFError, OSError, pickle.UnpicklingError):
                told.put(None)
                return
            told.put(message)
