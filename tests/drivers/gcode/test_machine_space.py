"""The origin of a controller's count follows from its settings and the position after homing."""

import pytest

from rotemina.drivers.contract import DeviceState, LimitError
from rotemina.drivers.gcode import EmulatedStage
from rotemina.drivers.gcode.controller_settings import ControllerSettings
from rotemina.drivers.gcode.error_texts import ControllerFirmware


class UpwardStage(EmulatedStage):
    """A stage that counts from 0 at its low switch, as with a forced origin."""

    after_pull_off = 1.0

    def _finish_axis(self, search, axis):
        super()._finish_axis(search, axis)
        self._blocks.set_position(axis, self.after_pull_off)

    def _is_in_travel(self, target):
        return not self.settings[20] or all(
            -1e-6 <= position <= travel + 1e-6
            for position, travel in zip(target.position, self._read_travels(), strict=True)
        )

    def _read_travels(self):
        return self._read_axis_settings(130)


class ZeroOriginStage(UpwardStage):
    after_pull_off = 0.0


class HundredOriginStage(UpwardStage):
    """FluidNC whose configuration contains the position of the switch."""

    after_pull_off = 100.0

    def _report_or_set(self, text):
        if text == "I":
            self._send("[VER:3.9 FluidNC v3.9.1 (esp32-wifi) :]")
        text = text.lower() if text.startswith("/") else text
        if text.startswith("/axes/"):
            value = "100.000" if text.endswith("mpos_mm") else "false"
            self._send(f"${text}={value}")
            return
        super()._report_or_set(text)

    def _is_in_travel(self, target):
        return all(
            100.0 - 1e-6 <= position <= 100.0 + travel + 1e-6
            for position, travel in zip(target.position, self._read_travels(), strict=True)
        )


@pytest.mark.parametrize(
    ("stage", "home_position", "soft_limits"),
    [(UpwardStage, 1.0, 0.0), (ZeroOriginStage, 0.0, 1.0), (HundredOriginStage, 0.0, 1.0)],
)
def test_a_controller_that_counts_upward_reaches_its_target(
    make_bench, stage, home_position, soft_limits
):
    bench = make_bench(stage=stage)
    bench.stage.settings[20] = soft_limits
    driver = bench.open_and_home()
    assert bench.read_position() == pytest.approx([home_position * 1e-3] * 3, abs=1e-9)
    driver.move_to({"x": 0.025})
    bench.wait_for_rest()
    # The switch is at 0. The axis is 1 mm above it when the count begins.
    assert bench.stage.true_positions[0] == pytest.approx(26.0 - home_position, abs=1e-3)


def test_an_axis_homed_outside_its_range_stays_unhomed(make_bench):
    class LongStage(EmulatedStage):
        """A stage with more travel than the robot file says, and its switch at the upper end."""

        def _finish_axis(self, search, axis):
            super()._finish_axis(search, axis)
            self._blocks.set_position(axis, -self.settings[27])

    bench = make_bench(stage=LongStage)
    bench.stage.settings |= {130: 200.0, 23: 0.0}
    bench.driver.open()
    bench.driver.home(bench.driver.homing_axes)
    bench.run(20.0)
    status = bench.driver.status()
    assert status.state is DeviceState.FAULT
    assert "after homing the controller counts -1.000 mm" in status.fault
    assert "0.000 to 50.000 mm, the controller travels 200.000 mm ($130)" in status.fault
    assert not status.position_known


def test_a_count_outside_the_range_is_not_trusted(make_bench):
    bench = make_bench(settings={"trust_position": True})
    bench.stage.settings[22] = 0.0
    bench.stage.receive(b"$X\n", 0.0)
    bench.stage.advance(0.1)
    bench.stage._blocks.set_position(0, 12.0)
    bench.clock.advance(0.2)
    bench.driver.open()
    assert bench.driver.status().unhomed == ("x",)
    with pytest.raises(LimitError, match="axes with one: no axis"):
        bench.driver.home(("x",))


@pytest.mark.parametrize(
    ("texts", "options", "position_after_homing", "low_end"),
    [
        ({"22": "1", "23": "1", "27": "1"}, "V", -49.0, -50.0),  # GRBL, low switch
        ({"22": "1", "23": "0", "27": "1"}, "V", -1.0, -50.0),  # GRBL, high switch
        ({"22": "1", "23": "1", "27": "1"}, "VZ", 0.0, 0.0),  # GRBL, forced origin, low
        ({"22": "9", "23": "0", "27": "1"}, "V", 0.0, -50.0),  # grblHAL, forced origin, high
        ({"22": "1", "23": "1", "27": "0"}, "V", -50.0, -50.0),
        ({"22": "1", "23": "1", "27": "1"}, "V", -25.0, None),
        ({"22": "1", "23": "1", "27": "1"}, "V", 75.0, None),
    ],
)
def test_the_low_end_follows_from_the_position_after_homing(
    texts, options, position_after_homing, low_end
):
    settings = ControllerSettings(texts, options, ControllerFirmware.GRBL)
    assert settings.find_low_end_after_homing("X", 0, 50.0, position_after_homing) == low_end


@pytest.mark.parametrize(
    ("texts", "options", "low_end"),
    [
        ({"22": "0"}, "V", -50.0),
        ({"22": "1", "23": "1"}, "VZ", 0.0),
        ({"22": "9", "23": "1"}, "V", 0.0),
        ({"22": "9", "23": "0"}, "V", -50.0),
        (
            {"/axes/x/homing/mpos_mm": "5.000", "/axes/x/homing/positive_direction": "true"},
            "PH",
            -45.0,
        ),
    ],
)
def test_before_homing_the_low_end_follows_from_the_settings(texts, options, low_end):
    settings = ControllerSettings(texts, options)
    assert settings.find_declared_low_end("X", 0, 50.0) == low_end
