"""What every test may use: an offscreen Qt and the folder of shared material."""

import os
from pathlib import Path

import pytest
from hypothesis import settings

# The same examples on every machine, however slow it is at the moment.
settings.register_profile("repeatable", derandomize=True, deadline=None, print_blob=True)
settings.load_profile("repeatable")

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

BESIDE_REPOSITORY = Path(__file__).parents[2] / "shared"


@pytest.fixture(scope="session")
def shared_dir() -> Path:
    """Folder of shared material: ``ROTEMINA_SHARED``, else ``../shared``."""
    folder = Path(os.environ.get("ROTEMINA_SHARED", BESIDE_REPOSITORY))
    if folder.is_dir():
        return folder
    absent = f"no shared material in {folder} (set ROTEMINA_SHARED)"
    if os.environ.get("CI") == "true":
        pytest.fail(absent)
    pytest.skip(absent)
