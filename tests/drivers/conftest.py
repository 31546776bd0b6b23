"""What tests of drivers share: a clock set by hand."""

import pytest

from rotemina.drivers.clock import VirtualClock


@pytest.fixture
def clock() -> VirtualClock:
    return VirtualClock(1234.5)
