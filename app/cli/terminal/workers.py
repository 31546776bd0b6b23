"""Parallel work on the cores of this computer or on a Dask cluster."""

import argparse
import warnings
from collections.abc import Iterator
from concurrent.futures import Future
from contextlib import contextmanager
from typing import Any
from uuid import uuid4

from rotemina.app.errors import CommandError

_CONNECT_TIMEOUT_S = 10


def add_workers(parser: argparse.ArgumentParser) -> None:
    """Add ``--jobs`` and ``--cluster``."""
    parser.add_argument(
        "--jobs",
        type=int,
        metavar="N",
        help="processes that work at once (default: one per usable core)",
    )
    parser.add_argument(
        "--cluster",
        metavar="ADDRESS",
        help="use a Dask cluster, such as tcp://host:8786 (needs the extra 'dask')",
    )


@contextmanager
def prepare_workers(jobs: int | None, cluster: str | None) -> Iterator[int]:
    """Prepare parallel work for the duration of the context; yield the number of jobs for joblib.

    Raises
    ------
    InputError
        If ``jobs`` is not positive, or the cluster cannot be used.
    """
    if jobs is not None and jobs < 1:
        raise CommandError("--jobs {jobs}: must be 1 or more", jobs=jobs)
    # The import is slow, and most subcommands do not need it.
    import joblib

    if cluster is None:
        yield jobs or joblib.cpu_count()
        return
    try:
        from distributed import Client, KilledWorker
    except ImportError as error:
        raise CommandError(
            "--cluster {cluster}: Dask is not installed; install it by pip install "
            "'rotemina[dask]', here and on the cluster's machines",
            cluster=cluster,
        ) from error
    try:
        client = Client(cluster, timeout=_CONNECT_TIMEOUT_S)
    except (OSError, ValueError) as error:
        raise CommandError(
            "--cluster {cluster} cannot be reached ({error}); name the address of a "
            "running Dask scheduler",
            cluster=cluster,
            error=str(error),
        ) from error
    with client, warnings.catch_warnings():
        # Dask warns about large tasks, but the records that a task needs make it large.
        warnings.filterwarnings("ignore", "Sending large graph")
        try:
            client.wait_for_workers(1, timeout=_CONNECT_TIMEOUT_S)
        except TimeoutError as error:
            raise CommandError(
                "--cluster {cluster} has no workers; start some by dask worker {cluster}",
                cluster=cluster,
            ) from error
        try:
            with joblib.parallel_config(backend=_make_dask_backend()):
                yield jobs or sum(client.ncores().values())
        except KilledWorker as error:
            raise CommandError(
                "--cluster: a worker died repeatedly at the same task ({error}); check "
                "its memory and its log",
                error=str(error),
            ) from error


def _make_dask_backend() -> Any:
    """Return joblib's backend for the current Dask client, extended to report errors of Dask.

    The original backend submits work in a callback of Dask's event loop, and the loop ignores
    exceptions of callbacks. The backend is also not notified when Dask gives up a piece of work. In
    both cases joblib would wait forever.
    """
    from joblib._dask import DaskDistributedBackend
    from joblib._utils import _TracebackCapturingWrapper

    class ErrorReportingBackend(DaskDistributedBackend):  # type: ignore[misc]  # joblib has no types
        def submit(self, func: Any, callback: Any = None) -> Any:
            result: Any = Future()
            # joblib expects futures whose ``result`` method is named ``get``.
            result.get = result.result

            async def send() -> None:
                try:
                    batch, tasks = await self._to_func_args(func)
                    work = _TracebackCapturingWrapper(batch)
                    key = f"{batch!r}-{uuid4().hex}"
                    future = self.client.submit(work, tasks=tasks, key=key, **self.submit_kwargs)
                except Exception as error:
                    # An exception that escaped from this callback would be lost.
                    reason = f"{type(error).__name__}: {error}"
                    result.set_exception(
                        CommandError("--cluster: work could not be sent: {said}", said=reason)
                    )
                    return
                self._callbacks[future], self._results[future] = callback, result
                self.waiting_futures.add(future)

            # joblib receives the error as if it were a result. retrieve_result_callback raises it.
            def report_failure(finished: Any) -> None:
                error = finished.exception()
                if error is not None and callback is not None:
                    callback(error)

            result.add_done_callback(report_failure)
            self.client.loop.add_callback(send)
            return result

        def retrieve_result_callback(self, out: Any) -> Any:
            if isinstance(out, BaseException):
                raise out
            return super().retrieve_result_callback(out)

    return ErrorReportingBackend()
