"""Fixture for records of real machines."""

import runpy
import sys

import pytest


@pytest.fixture(scope="session")
def real_dir(shared_dir, tmp_path_factory):
    """Folder of the records of real machines, converted by their own script."""
    folder = tmp_path_factory.mktemp("real")
    arguments, sys.argv = sys.argv, ["convert.py", str(folder)]
    try:
        runpy.run_path(str(shared_dir / "data" / "convert.py"), run_name="__main__")
    finally:
        sys.argv = arguments
    return folder
