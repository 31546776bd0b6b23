"""Parallel work on a real Dask scheduler of this machine."""

import joblib
import pytest

from rotemina.app.cli.workers import workers
from rotemina.sim.errors import InputError

pytestmark = pytest.mark.slow  # starts processes


@pytest.fixture
def cluster():
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
    ) as cluster:
        yield cluster


class Unsendable:
    """Large enough to be sent by itself, and impossible to send."""

    def __init__(self):
        self.large = bytes(10_000)

    def __sizeof__(self):
        return 10_000

    def __reduce__(self):
        raise RuntimeError("dictionary changed size during iteration")


def _nothing(_):
    return None


def test_work_that_cannot_be_sent_ends_the_run_with_an_error(cluster):
    with (
        workers(None, cluster.scheduler_address) as jobs,
        pytest.raises(InputError, match=r"could not be sent: .*Unsendable"),
    ):
        joblib.Parallel(n_jobs=jobs)([joblib.delayed(_nothing)(Unsendable())])
