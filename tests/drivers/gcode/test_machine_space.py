"""Where a controller's count begins, by its settings and by where homing ends."""

import pytest

from rotemina.drivers.errors import LimitError
from rotemina.drivers.gcode.controller_settings import ControllerSettings
from rotemina.drivers.gcode.emulator import EmulatedStage
from rotemina.drivers.gcode.error_texts import Firmware
from rotemina.drivers.samples import DeviceState


class CountsUpward(EmulatedStage):
    """Counts from 0 at its low switch, as with a forced origin."""

    after_pull_off = 1.0

    def _found(self, search, axis):
        super()._found(search, axis)
        self._blocks.set(axis, self.after_pull_off)

    def _inside(self, target):
        return not self.settings[20] or all(
            -1e-6 <= at <= way + 1e-6
            for at, way in zip(target.position, self._each(130), strict=True)
        )


class CountsFromZero(CountsUpward):
    after_pull_off = 0.0


class CountsFromHundred(CountsUpward):
    """FluidNC with a position of the switch in its configuration."""

    after_pull_off = 100.0

    def _tell_or_set(self, text):
        if text == "I":
            self._say("[VER:3.9 FluidNC v3.9.1 (esp32-wifi) :]")
        text = text.lower() if text.startswith("/") else text
        if text.startswith("/axes/"):
            value = "100.000" if text.endswith("mpos_mm") else "false"
            self._say(f"${text}={value}")
            return
        super()._tell_or_set(text)

    def _inside(self, target):
        return all(
            100.0 - 1e-6 <= at <= 100.0 + way + 1e-6
            for at, way in zip(target.position, self._each(130), strict=True)
        )


@pytest.mark.parametrize(
    ("stage", "at_home"), [(CountsUpward, 1.0), (CountsFromZero, 0.0), (CountsFromHundred, 0.0)]
)
@pytest.mark.parametrize("soft_limits", [0.0, 1.0])
def test_a_controller_that_counts_upward_goes_where_it_is_sent(joined, stage, at_home, soft_limits):
    bench = joined(stage=stage)
    bench.stage.settings[20] = soft_limits
    driver = bench.homed()
    assert bench.at() == pytest.approx([at_home * 1e-3] * 3, abs=1e-9)
    driver.move_to({"x": 0.025})
    bench.rest()
    # The switch is at 0; the axis stands 1 mm above it when the count begins.
    assert bench.stage.true[0] == pytest.approx(26.0 - at_home, abs=1e-3)


def test_an_axis_that_is_homed_outside_its_range_stays_unknown(joined):
    class Far(EmulatedStage):
        """Travels farther than the robot file, with its switch at the upper end."""

        def _found(self, search, axis):
            super()._found(search, axis)
            self._blocks.set(axis, -self.settings[27])

    bench = joined(stage=Far)
    bench.stage.settings |= {130: 200.0, 23: 0.0}
    bench.driver.open()
    bench.driver.home(bench.driver.homing_axes)
    bench.run(20.0)
    status = bench.driver.status()
    assert status.state is DeviceState.FAULT
    assert "after homing the controller counts -1.000 mm" in status.fault
    assert "0.000 to 50.000 mm, the controller travels 200.000 mm ($130)" in status.fault
    assert not status.position_known


def test_a_count_outside_the_range_is_not_trusted(joined):
    bench = joined(settings={"trust_position": True})
    bench.stage.settings[22] = 0.0
    bench.stage.receive(b"$X\n", 0.0)
    bench.stage.advance(0.1)
    bench.stage._blocks.set(0, 12.0)
    bench.clock.advance(0.2)
    bench.driver.open()
    assert bench.driver.status().unhomed == ("x",)
    with pytest.raises(LimitError, match="no axis has any"):
        bench.driver.home(("x",))


@pytest.mark.parametrize(
    ("texts", "options", "homed_at", "low_end"),
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
def test_the_low_end_follows_from_where_homing_ends(texts, options, homed_at, low_end):
    settings = ControllerSettings(texts, options, Firmware.GRBL)
    assert settings.low_end_after_homing("X", 0, 50.0, homed_at) == low_end


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
def test_before_homing_the_settings_say_where_the_count_begins(texts, options, low_end):
    settings = ControllerSettings(texts, options)
    assert settings.declared_low_end("X", 0, 50.0) == low_end
