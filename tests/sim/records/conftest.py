"""Fixtures for files that tests write, and for all ways to parse them."""

from collections.abc import Callable
from pathlib import Path

import pytest

from rotemina.sim.records import FileLimits

WriteFile = Callable[..., Path]

STRICT = FileLimits(small_block_bytes=1_000_000_000)
FAST = FileLimits(small_block_bytes=0)
# Blocks of one or two lines: the content of one block must not affect the next.
FAST_IN_SMALL_BLOCKS = FileLimits(small_block_bytes=0, block_bytes=11)


@pytest.fixture(
    params=[STRICT, FAST, FAST_IN_SMALL_BLOCKS], ids=["strict", "fast", "fast in pieces"]
)
def limits(request: pytest.FixtureRequest) -> FileLimits:
    """Limits for each way to parse a file; all must give the same result."""
    return request.param


@pytest.fixture
def write_file(tmp_path: Path) -> WriteFile:
    """Return a function that writes bytes or text to a file, and returns its path."""

    def write(content: bytes | str, name: str = "run.csv") -> Path:
        path = tmp_path / name
        path.write_bytes(content.encode() if isinstance(content, str) else content)
        return path

    return write
