"""Errors say what they were raised with."""

from rotemina.drivers.errors import ConnectionLostError, LimitError
from rotemina.sim.errors import InputError
from rotemina.sim.messages import AxisName, message


def test_the_text_of_an_error_is_the_message_itself():
    told = message("engine", "axis {axis} moves").fill(axis=AxisName("zn"))
    for kind in (InputError, LimitError, ConnectionLostError):
        assert str(kind(told)) is told
    assert str(InputError("plain")) == "plain"
    assert str(ConnectionLostError(5, "gone")) == "[Errno 5] gone"
