"""Fixture for tests of drivers: a virtual clock."""

import pytest

from rotemina.drivers.contract import VirtualClock


@pytest.fixture
def clock() -> VirtualClock:
    return VirtualClock(1234.5)
