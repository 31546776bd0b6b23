"""Diagnoses in a process of their own: their work never holds the interpreter of the window.

The process is this program's own, so what goes between the two is pickled.
"""

import multiprocessing
import os
import signal
import threading
import traceback
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from multiprocessing.connection import Connection
from multiprocessing.context import SpawnProcess
from multiprocessing.reduction import ForkingPickler
from types import MappingProxyType

from rotemina.plugins.gap.answer import Answer
from rotemina.sim.errors import InputError
from rotemina.sim.gap.progress import Listener, Progress
from rotemina.sim.records.record import Record
from rotemina.sim.robot.model import Robot

_LOOKS_S = 0.05  # between two questions whether an answer is still wanted
_NICE = 5  # the window and what steers the machine go first
_PATIENCE_S = 2.0  # before a process that does not end its work is ended itself


def _frozen(mapping: dict[object, object]) -> MappingProxyType[object, object]:
    return MappingProxyType(mapping)  # itself it has no name by which another process could call it


# Records and robots hold some.
ForkingPickler.register(MappingProxyType, lambda proxy: (_frozen, (dict(proxy),)))


class DiagnosisError(RuntimeError):
    """A fault of the program in the process of the diagnosis."""


@dataclass(frozen=True, slots=True)
class _Request:
    robot: Robot
    names: tuple[str, ...]
    records: tuple[Record, ...]


@dataclass(frozen=True, slots=True)
class _Failure:
    """Why there is no answer: what is wrong with the request, or a fault with its traceback."""

    reason: str
    by_input: bool


class _Unwanted:
    """Says that no answer is wanted any more."""


class _UnwantedError(Exception):
    pass


class DiagnosisProcess:
    """A process that diagnoses records; it starts with the first request and stays for others."""

    def __init__(self) -> None:
        self._process: SpawnProcess | None = None
        self._connection: Connection | None = None

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
        connection = self._ready()
        latest = Progress("reading", None, None, 0.0)
        try:
            connection.send(_Request(robot, tuple(names), tuple(records)))
            while True:
                listener(latest)
                if not connection.poll(_LOOKS_S):
                    continue
                told = connection.recv()
                if isinstance(told, Progress):
                    latest = told
                    continue
                if isinstance(told, Answer):
                    return replace(told, records=tuple(records))
                raise (InputError if told.by_input else DiagnosisError)(told.reason)
        except (EOFError, OSError):
            status = self.close()
            raise InputError(
                f"the process of the diagnosis has ended (status {status}) before it answered; "
                "is there memory enough? Diagnose again, with fewer or shorter records"
            ) from None
        except (InputError, DiagnosisError):
            raise
        except BaseException:
            self._interrupt(connection)
            raise

    def close(self) -> int | None:
        """End the process, if there is one, and return its status."""
        process, connection = self._process, self._connection
        self._process = self._connection = None
        if process is None or connection is None:
            return None
        connection.close()
        process.join(_PATIENCE_S)
        if process.is_alive():
            process.kill()
            process.join()
        status = process.exitcode
        process.close()
        return status

    def _ready(self) -> Connection:
        if self._process is not None and not self._process.is_alive():
            self.close()
        if self._connection is None:
            # A new interpreter on every system: a copy of this one would hold its window's locks.
            context = multiprocessing.get_context("spawn")
            self._connection, other = context.Pipe()
            self._process = context.Process(
                target=_serve, args=(other,), name="diagnosis", daemon=True
            )
            self._process.start()
            other.close()
        return self._connection

    def _interrupt(self, connection: Connection) -> None:
        """Let the work end at its next step, or the process if that does not come soon."""
        try:
            connection.send(_Unwanted())
            while connection.poll(_PATIENCE_S):
                if not isinstance(connection.recv(), Progress):
                    return
        except (EOFError, OSError):
            pass
        if self._process is not None:
            self._process.kill()
        self.close()


def _serve(connection: Connection) -> None:
    """Answer requests until the other side is gone."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the window's, which ends this one
    if hasattr(os, "nice"):
        os.nice(_NICE)
    with suppress(EOFError, OSError):
        while True:
            request = connection.recv()
            if isinstance(request, _Request):  # one may be told too late that it is unwanted
                connection.send(_reply(request, connection))


def _reply(request: _Request, connection: Connection) -> Answer | _Failure:
    latest: Progress | None = None
    guard = threading.Lock()  # steps come from any thread

    def listen(progress: Progress) -> None:
        nonlocal latest
        with guard:
            if connection.poll():
                connection.recv()
                raise _UnwantedError
            if progress is not latest:  # which comes again before every simulation
                latest = progress
                connection.send(progress)

    try:
        from rotemina.sim.gap import method  # takes its time to import

        # One core stays free for the machine and the window.
        jobs = max((os.cpu_count() or 1) - 1, 1)
        diagnosis = method.diagnose(request.robot, request.records, jobs=jobs, listener=listen)
        listen(Progress("drawing", None, None, 1.0))
        answer = Answer.of(diagnosis, request.names, request.records)
        return replace(answer, records=())  # which the other side has
    except _UnwantedError:
        return _Failure("stopped", by_input=True)
    except InputError as error:
        return _Failure(str(error), by_input=True)
    except (EOFError, OSError):
        raise
    except Exception:
        return _Failure(traceback.format_exc(), by_input=False)
