"""The driver of the MC68HC11 boards: the contract's hooks, filled by one session of links.

All traffic happens in the calls of the one thread that uses the driver; only a stop is written to
the ports by whoever calls it.
"""

from rotemina.drivers.mc68hc11.board_services import Extras
from rotemina.drivers.mc68hc11.moving import Moving


class MC68HC11(Moving, Extras):
    """One or two MC68HC11 boards at the end of serial lines.

    Settings: ``port``, a device or a URL of pyserial; ``second_port`` of the second board, empty
    for a robot of up to three axes, or for both boards on one shared bus; ``baud``; ``settle_s`` at
    the first row of a trajectory; ``watchdog_s``, after what silence of this program a board halts;
    ``latency_s``, what the operating system and adapters may add to a round trip, unless a longer
    one is measured when the boards are opened.

    Parameters
    ----------
    robot, settings, clock
        See :class:`rotemina.drivers.driver.Driver`.
    open_port : callable
        Return an open port of a URL and a baud rate.
    pause : callable
        Let some seconds pass, while the boards are opened.
    """
