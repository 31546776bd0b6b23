"""The boards' driver, put to the conformance kit over lines in memory to virtual boards."""

import pytest

from rotemina.drivers.byte_channels import ByteChannel
from rotemina.drivers.clock import VirtualClock
from rotemina.drivers.conformance.bench import Bench as KitBench
from rotemina.drivers.conformance.check import Verdict
from rotemina.drivers.conformance.suite import CHECKS
from rotemina.drivers.mc68hc11.driver import MC68HC11
from rotemina.drivers.serial_port import SerialPort
from rotemina.drivers.virtual_board.boards import VirtualBoards

pytestmark = pytest.mark.slow
# Its clock is looked at by whoever advances it too, so the kit cannot tell when a read begins.
# The boards have no output for a tool.
NOT_HERE = {"stop-during-a-read", "stop-when-called", "tool"}


class BlockableChannel(ByteChannel):
    """A line in memory that takes no bytes while its port is blocked."""

    def __init__(self, port):
        self._port = port
        self.blocked = False

    def read(self):
        return self._port.read()

    def write(self, data):
        if self.blocked:
            return 0
        self._port.write(data)
        return len(data)

    def close(self):
        self._port.close()


class Surroundings:
    """Boards that stay, whatever drivers come and go."""

    def __init__(self, robot, ports, memory_port):
        self.robot = robot
        self.count = ports
        self.clock = VirtualClock(1234.5)
        self.begin_s = self.clock()
        self.memory_port = memory_port
        self.boards = VirtualBoards(robot, ports=ports, position_known=True)
        self.ports = []
        self.channels = []
        self.opened = 0

    def make(self, settings):
        own = {"port": "first", "settle_s": 0.05}
        if self.count == 2:
            own["second_port"] = "second"
        return MC68HC11(
            self.robot,
            {**own, **settings},
            clock=self.clock,
            open_port=self.open_port,
            pause=self.clock.advance,
        )

    def open_port(self, url, _baud):
        port = self.memory_port(self.boards.lines[url == "second"], self.clock)
        port.begin_s = self.begin_s
        self.ports.append(port)
        self.opened += 1
        self.channels.append(BlockableChannel(port))
        return SerialPort(url, self.channels[-1], self.clock)

    def set_link(self, *, cut):
        for port in self.ports:
            port.cut = cut

    def set_ports(self, *, blocked):
        for channel in self.channels:
            channel.blocked = blocked

    def damage_once(self):
        """Change one byte of what the boards say next."""

        def damage(port, data):
            if not data:
                return data
            port.to_host = lambda data: data
            middle = len(data) // 2
            return data[:middle] + bytes([data[middle] ^ 0x55]) + data[middle + 1 :]

        for port in self.ports:
            port.to_host = lambda data, port=port: damage(port, data)

    def delay(self, seconds):
        for port in self.boards.lines:
            port._line.to_board.delay_s = port._line.to_host.delay_s = seconds

    def bench(self):
        return KitBench(
            make=self.make,
            advance=self.clock.advance,
            cut_link=lambda: self.set_link(cut=True),
            restore_link=lambda: self.set_link(cut=False),
            misreport=self.damage_once,
            delay_line=self.delay,
            block_port=lambda: self.set_ports(blocked=True),
            unblock_port=lambda: self.set_ports(blocked=False),
            touched=lambda: self.opened > 0,
        )


@pytest.mark.parametrize("ports", [2, 1], ids=["two lines", "shared bus"])
def test_the_boards_keep_the_contract(robot, memory_port, ports):
    wrong, passed = [], 0
    for check in CHECKS:
        result = check.run(Surroundings(robot, ports, memory_port).bench())
        if result.verdict is Verdict.PASSED:
            passed += 1
        elif result.verdict is not Verdict.SKIPPED or check.name not in NOT_HERE | {"fault"}:
            wrong.append(f"{check.name}: {result.verdict}: {result.demand} {result.note}")
    assert not wrong
    assert passed >= len(CHECKS) - len(NOT_HERE) - 1
