"""Files that tests write, and both ways to parse them."""

from collections.abc import Callable
from pathlib import Path

import pytest

from rotemina.sim.records.file_blocks import Limits

WriteFile = Callable[..., Path]

STRICT = Limits(small_block_bytes=1_000_000_000)
FAST = Limits(small_block_bytes=0)
# Blocks of a line or two: what stands in one block must not matter to the next.
FAST_IN_PIECES = Limits(small_block_bytes=0, block_bytes=11)


@pytest.fixture(params=[STRICT, FAST, FAST_IN_PIECES], ids=["strict", "fast", "fast in pieces"])
def limits(request: pytest.FixtureRequest) -> Limits:
    """Each way to parse a file, which must all agree."""
    return request.param


@pytest.fixture
def write_file(tmp_path: Path) -> WriteFile:
    """Write bytes or text to a file and return its path."""

    def write(content: bytes | str, name: str = "run.csv") -> Path:
        path = tmp_path / name
        path.write_bytes(content.encode() if isinstance(content, str) else content)
        return path

    return write
