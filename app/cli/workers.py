"""Where parallel work runs: on this machine's cores, or on a Dask cluster."""

import argparse
import warnings
from collections.abc import Iterator
from concurrent.futures import Future
from contextlib import contextmanager
from typing import Any
from uuid import uuid4

from rotemina.sim.errors import InputError
from rotemina.sim.messages import message

_CONNECTING_S = 10


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
def workers(jobs: int | None, cluster: str | None) -> Iterator[int]:
    """Prepare parallel work, and return the number of jobs for joblib.

    Raises
    ------
    InputError
        If ``jobs`` is not positive, or the cluster cannot be used.
    """
    if jobs is not None and jobs < 1:
        raise InputError(message("cli", "--jobs {jobs}: must be 1 or more").fill(jobs=jobs))
    import joblib  # takes its time to import

    if cluster is None:
        yield jobs or joblib.cpu_count()
        return
    try:
        from distributed import Client, KilledWorker
    except ImportError as error:
        raise InputError(
            message(
                "cli",
                "--cluster {cluster}: Dask is not installed; install it by pip install "
                "'rotemina[dask]', here and on the cluster's machines",
            ).fill(cluster=cluster)
        ) from error
    try:
        client = Client(cluster, timeout=_CONNECTING_S)
    except (OSError, ValueError) as error:
        raise InputError(
            message(
                "cli",
                "--cluster {cluster} cannot be reached ({error}); name the address of a "
                "running Dask scheduler",
            ).fill(cluster=cluster, error=str(error))
        ) from error
    with client, warnings.catch_warnings():
        # Records are sent with what is to be done to them, whatever Dask thinks of their size.
        warnings.filterwarnings("ignore", "Sending large graph")
        try:
            client.wait_for_workers(1, timeout=_CONNECTING_S)
        except TimeoutError as error:
            raise InputError(
                message(
                    "cli",
                    "--cluster {cluster} has no workers; start some by dask worker {cluster}",
                ).fill(cluster=cluster)
            ) from error
        try:
            with joblib.parallel_config(backend=_backend()):
                yield jobs or sum(client.ncores().values())
        except KilledWorker as error:
            raise InputError(
                message(
                    "cli",
                    "--cluster: a worker died repeatedly at the same task ({error}); check "
                    "its memory and its log",
                ).fill(error=str(error))
            ) from error


def _backend() -> Any:
    """Return joblib's way to the current Dask client, on which failures of Dask's are told.

    By itself joblib submits in a callback of Dask's loop, which swallows what is raised there, and
    hears of no work that Dask gave up: whoever waits for the result waits for ever.
    """
    from joblib._dask import DaskDistributedBackend
    from joblib._utils import _TracebackCapturingWrapper

    class Telling(DaskDistributedBackend):  # type: ignore[misc]  # joblib has no types
        def submit(self, func: Any, callback: Any = None) -> Any:
            told: Any = Future()
            told.get = told.result  # joblib's name for it

            async def send() -> None:
                try:
                    batch, tasks = await self._to_func_args(func)
                    work = _TracebackCapturingWrapper(batch)
                    key = f"{batch!r}-{uuid4().hex}"
                    sent = self.client.submit(work, tasks=tasks, key=key, **self.submit_kwargs)
                except Exception as error:  # nobody else would hear of it
                    said = f"{type(error).__name__}: {error}"
                    told.set_exception(
                        InputError(
                            message("cli", "--cluster: work could not be sent: {said}").fill(
                                said=said
                            )
                        )
                    )
                    return
                self._callbacks[sent], self._results[sent] = callback, told
                self.waiting_futures.add(sent)

            def give_up(done: Any) -> None:
                error = done.exception()
                if error is not None and callback is not None:
                    callback(error)

            told.add_done_callback(give_up)
            self.client.loop.add_callback(send)
            return told

        def retrieve_result_callback(self, out: Any) -> Any:
            if isinstance(out, BaseException):
                raise out
            return super().retrieve_result_callback(out)

    return Telling()
