"""The simulated microscope over the simulator: it shows where the machine truly is."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.drivers.cameras.errors import CameraLostError, CameraSettingError
from rotemina.drivers.cameras.settings import CameraSettings
from rotemina.drivers.cameras.simulated import SimulatedMicroscope
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.kinematics.chain import Chain
from rotemina.sim.kinematics.forward import tip_position
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect, Tool

ROBOT = load_robot("rotemina")


class Bench:
    """A simulator, its microscope, and the clock of both."""

    def __init__(self, clock, robot=ROBOT, **options):
        self.clock = clock
        self.driver = Simulator(robot, clock=clock)
        self.source = SimulatedMicroscope(
            lambda: self.driver, clock=clock, wait=clock.advance, **options
        )
        self.camera = self.source.camera(self.source.devices()[0])
        self.camera.open()

    def settle(self, **targets):
        """Send axes there and let them come to rest."""
        self.driver.move_to(targets)
        for _ in range(20):
            self.clock.advance(0.1)
            self.driver.read()


def true_tip(driver):
    chain = Chain.of(driver.robot)
    return tip_position(chain, chain.joints_of(np.array(driver.true_positions)))


def dark_centre(frame):
    """Return the centroid (u, v) of an upright pin's spot."""
    pixels = frame.pixels.astype(float)
    level = np.median(pixels)
    v, u = np.unravel_index(np.argmin(pixels), pixels.shape)
    part = np.maximum(0.9 * level - pixels[v - 9 : v + 10, u - 9 : u + 10], 0.0)
    rows, columns = np.indices(part.shape)
    return np.array([(part * columns).sum(), (part * rows).sum()]) / part.sum() + [u - 9, v - 9]


def test_it_follows_effects_and_not_commands(clock):
    upright = replace(ROBOT, tool=Tool(approach_angle=np.pi / 2))
    play = AxisEffect(axis="x", id="backlash", parameters={"width": 2e-6})
    bench = Bench(clock, replace(upright, effects=(play,)))
    bench.driver.open()
    for x in (0.0276, 0.0275):
        bench.settle(x=x)
    seen = dark_centre(bench.camera.grab(1.0))
    optics = bench.camera.scene.optics
    commanded = np.array([0.0275, *bench.driver.true_positions[1:]])
    chain = Chain.of(upright)
    said = optics.pixel_of(tip_position(chain, commanded))
    np.testing.assert_allclose(seen, optics.pixel_of(true_tip(bench.driver)), atol=0.15)
    assert abs(seen[0] - said[0]) > 1.0  # backlash, in px


def test_the_cell_is_drawn_where_the_tip_feels_it(clock):
    bench = Bench(clock)
    bench.driver.open()
    bench.camera.grab(1.0)
    beside = bench.camera.scene.cell
    low, at = ROBOT.axes["zn"].range[0], bench.driver.true_positions[bench.driver.axes.index("zn")]
    values = {"place": at - low - 5e-6, "stiffness": -0.1}
    bench.driver.set_effects((AxisEffect(axis="zn", id="contact", parameters=values),))
    bench.camera.grab(1.0)
    cell = bench.camera.scene.cell
    assert cell.level(true_tip(bench.driver)) > 1.05
    bench.settle(zn=at - 4.9e-6)
    assert cell.level(true_tip(bench.driver)) == pytest.approx(1.0, abs=0.02)  # 5 µm ahead
    assert bench.camera.grab(1.0).metadata["pierced"] is False
    bench.driver.set_effects(())
    bench.camera.grab(1.0)
    assert bench.camera.scene.cell == beside  # it is taken away

    bench.driver.set_effects((AxisEffect(axis="zn", id="contact", parameters=values),))
    bench.settle(zn=at - 7e-6)
    bench.camera.grab(1.0)
    bench.driver.set_effects(())  # while the tip is inside: the membrane gives way
    assert bench.camera.grab(1.0).metadata["pierced"] is True
    assert bench.camera.scene.cell != beside


def test_the_true_position_is_what_the_plant_says_and_may_be_had_of_a_closed_machine(clock):
    driver = Simulator(ROBOT, clock=clock)
    assert driver.true_positions[:3] == (0.0275, 0.0275, 0.04)
    driver.open()
    driver.move_to({"x": 0.0276})
    clock.advance(2.0)
    driver.read()
    assert driver.true_positions[0] == pytest.approx(0.0276, abs=1e-9)
    driver.close()
    assert driver.true_positions[0] == pytest.approx(0.0276, abs=1e-9)


def test_a_machine_that_is_disconnected_stays_where_it_was(clock):
    bench = Bench(clock)
    bench.driver.open()
    bench.settle(x=0.02745)
    before = bench.camera.grab(1.0)
    bench.driver = None
    after = bench.camera.grab(1.0)
    assert abs(after.pixels.astype(int) - before.pixels.astype(int)).mean() < 40.0
    np.testing.assert_allclose(bench.camera._joints[0], 0.02745, atol=1e-8)
    bench.driver = Simulator(load_robot("rotemina"), clock=clock)  # the same robot, connected anew
    assert bench.camera.grab(1.0) is not None


def test_only_a_simulated_machine_can_be_seen(clock):
    source = SimulatedMicroscope(lambda: None, clock=clock, wait=clock.advance)
    assert (source.devices(), source.problem) == ((), None)
    bench = Bench(clock)
    bench.camera.close()
    bench.driver = type("R", (), {"name": "real"})()
    assert bench.source.devices() == ()
    assert "real shows only a simulated machine" in bench.source.problem
    with pytest.raises(CameraLostError, match="connect the simulator"):
        bench.camera.open()


def test_another_robot_is_another_machine(clock):
    bench = Bench(clock)
    bench.driver = Simulator(load_robot("fsm"), clock=clock)
    with pytest.raises(CameraLostError, match="close it and open it again"):
        bench.camera.grab(1.0)


def test_frames_come_at_their_rate_and_those_nobody_took_are_counted(clock):
    bench = Bench(clock)
    began_s = clock()
    shown = [bench.camera.grab(1.0) for _ in range(5)]
    assert clock() - began_s == pytest.approx(4 / 30.0)
    assert [frame.number for frame in shown] == [0, 1, 2, 3, 4]
    clock.advance(10.5 / 30.0)
    late = bench.camera.grab(1.0)
    assert (late.number, late.lost) == (14, 9)
    bench.camera.configure(CameraSettings(exposure_s=0.5))
    bench.camera.grab(1.0)
    before_s = clock()
    bench.camera.grab(1.0)
    assert clock() - before_s == pytest.approx(0.5)


def test_exposure_and_gain_brighten(clock):
    bench = Bench(clock)
    levels = []
    for settings in (
        CameraSettings(exposure_s=0.005),
        CameraSettings(exposure_s=0.01),
        CameraSettings(exposure_s=0.01, gain=2.0),
    ):
        bench.camera.configure(settings)
        levels.append(bench.camera.grab(1.0).pixels.mean() - 40.0)
    assert levels[1] / levels[0] == pytest.approx(2.0, rel=0.01)
    assert levels[2] / levels[1] == pytest.approx(2.0, rel=0.01)


def test_the_focus_drive(clock):
    bench = Bench(clock)
    sharp = np.abs(np.diff(bench.camera.grab(1.0).pixels[505:525, 655].astype(float))).max()
    bench.camera.move_focus(40e-6)
    frame = bench.camera.grab(1.0)
    assert frame.metadata["focus_m"] == bench.camera.focus_m == 40e-6
    assert np.abs(np.diff(frame.pixels[505:525, 655].astype(float))).max() < 0.6 * sharp
    with pytest.raises(CameraSettingError, match="focus at 600 µm"):
        bench.camera.move_focus(600e-6)
    with pytest.raises(CameraSettingError, match="focus at nan"):
        bench.camera.move_focus(float("nan"))
    assert bench.camera.focus_m == 40e-6


def test_a_penetration_leaves_a_hole_until_the_cell_is_replaced(clock):
    bench = Bench(clock)
    bench.driver.open()
    bench.camera.grab(1.0)
    centre = bench.camera.scene.cell.centre_m
    joints = np.array(bench.driver.true_positions)
    way = np.array(centre) - true_tip(bench.driver)
    bench.settle(y=joints[1] + way[1])
    assert not bench.camera.grab(1.0).metadata["pierced"]
    bench.settle(x=joints[0] + way[0])
    assert bench.camera.grab(1.0).metadata["pierced"]
    bench.settle(x=joints[0])
    assert bench.camera.grab(1.0).metadata["pierced"]
    bench.camera.replace_cell()
    assert not bench.camera.grab(1.0).metadata["pierced"]


def test_the_same_seed_gives_the_same_frames(clock):
    one, other, third = (Bench(clock, seed=seed).camera.grab(1.0).pixels for seed in (3, 3, 4))
    np.testing.assert_array_equal(one, other)
    assert (one != third).mean() > 0.9


def test_how_the_camera_is_mounted_is_part_of_the_scene(clock):
    bench = Bench(clock, mounting={"rotation_rad": 0.3, "mirrored": True})
    assert bench.camera.scene.optics.rotation_rad == 0.3
    assert bench.camera.scene.optics.mirrored
