"""The conformance suite, run on the boards' driver with lines in memory to virtual boards."""

import pytest

from rotemina.drivers.conformance import CHECKS, CheckVerdict, DriverBench as ConformanceBench
from rotemina.drivers.contract import VirtualClock
from rotemina.drivers.mc68hc11.driver import MC68HC11Driver
from rotemina.drivers.serial_lines.byte_channels import ByteChannel
from rotemina.drivers.serial_lines.serial_port import SerialPort
from rotemina.drivers.virtual_board import VirtualBoards

pytestmark = pytest.mark.slow
# The function that advances the clock reads it too, so the suite cannot detect when a read begins.
# The boards have no output for a tool.
IRRELEVANT_CHECKS = {"stop-during-a-read", "stop-when-called", "tool"}


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


class LastingBoards:
    """Virtual boards that outlast the drivers which use them."""

    def __init__(self, robot, ports, memory_port):
        self.robot = robot
        self.count = ports
        self.clock = VirtualClock(1234.5)
        self.begin_s = self.clock()
        self.memory_port = memory_port
        self.boards = VirtualBoards(robot, ports=ports, position_known=True)
        self.ports = []
        self.channels = []
        self.open_count = 0

    def make(self, settings):
        port_settings = {"port": "first", "settle_s": 0.05}
        if self.count == 2:
            port_settings["second_port"] = "second"
        return MC68HC11Driver(
            self.robot,
            {**port_settings, **settings},
            clock=self.clock,
            open_port=self.open_port,
            pause=self.clock.advance,
        )

    def open_port(self, url, _baud):
        port = self.memory_port(self.boards.host_ports[url == "second"], self.clock)
        port.begin_s = self.begin_s
        self.ports.append(port)
        self.open_count += 1
        self.channels.append(BlockableChannel(port))
        return SerialPort(url, self.channels[-1], self.clock)

    def set_link(self, *, cut):
        for port in self.ports:
            port.is_cut = cut

    def set_ports(self, *, blocked):
        for channel in self.channels:
            channel.blocked = blocked

    def damage_once(self):
        """Change one byte of the next data from the boards."""

        def damage(port, data):
            if not data:
                return data
            port.to_host = lambda data: data
            middle = len(data) // 2
            return data[:middle] + bytes([data[middle] ^ 0x55]) + data[middle + 1 :]

        for port in self.ports:
            port.to_host = lambda data, port=port: damage(port, data)

    def delay(self, seconds):
        for port in self.boards.host_ports:
            port._line.to_board.delay_s = port._line.to_host.delay_s = seconds

    def make_conformance_bench(self):
        return ConformanceBench(
            make=self.make,
            advance=self.clock.advance,
            cut_link=lambda: self.set_link(cut=True),
            restore_link=lambda: self.set_link(cut=False),
            misreport=self.damage_once,
            delay_line=self.delay,
            block_port=lambda: self.set_ports(blocked=True),
            unblock_port=lambda: self.set_ports(blocked=False),
            was_device_contacted=lambda: self.open_count > 0,
        )


@pytest.mark.parametrize("ports", [2, 1], ids=["two lines", "shared bus"])
def test_the_boards_fulfil_the_contract(robot, memory_port, ports):
    failures, passed_count = [], 0
    for check in CHECKS:
        result = check.run(LastingBoards(robot, ports, memory_port).make_conformance_bench())
        if result.verdict is CheckVerdict.PASSED:
            passed_count += 1
        elif result.verdict is not CheckVerdict.SKIPPED or check.name not in IRRELEVANT_CHECKS | {
            "fault"
        }:
            failures.append(f"{check.name}: {result.verdict}: {result.requirement} {result.note}")
    assert not failures
    assert passed_count >= len(CHECKS) - len(IRRELEVANT_CHECKS) - 1
