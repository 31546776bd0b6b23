"""Real records."""

import runpy
import sys

import pytest


@pytest.fixture(scope="session")
def real_dir(shared_dir, tmp_path_factory):
    """The records of real machines, converted by the script that comes with them."""
    folder = tmp_path_factory.mktemp("real")
    arguments, sys.argv = sys.argv, ["convert.py", str(folder)]
    try:
        runpy.run_path(str(shared_dir / "data" / "convert.py"), run_name="__main__")
    finally:
        sys.argv = arguments
    return folder
