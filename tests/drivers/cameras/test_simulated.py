"""The simulated microscope shows the true position of the simulated machine."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.drivers.cameras import CameraSettings, SimulatedMicroscope
from rotemina.drivers.contract import CameraLostError, CameraSettingError
from rotemina.drivers.simulator import Simulator
from rotemina.sim.kinematics import KinematicChain, compute_tip_position
from rotemina.sim.robot import AxisEffect, RobotTool
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")


class Bench:
    """A simulator, its microscope, and their common clock."""

    def __init__(self, clock, robot=ROBOT, **options):
        self.clock = clock
        self.driver = Simulator(robot, clock=clock)
        self.source = SimulatedMicroscope(
            lambda: self.driver, clock=clock, wait=clock.advance, **options
        )
        self.camera = self.source.camera(self.source.devices()[0])
        self.camera.open()

    def settle(self, **targets):
        """Move axes to targets and wait until they are at rest."""
        self.driver.move_to(targets)
        for _ in range(20):
            self.clock.advance(0.1)
            self.driver.read()


def true_tip_position(driver):
    chain = KinematicChain.of(driver.robot)
    return compute_tip_position(chain, chain.select_joints(np.array(driver.true_positions)))


def find_spot_centre(frame):
    """Return the centroid (u, v) of the dark spot of an upright pin, in px."""
    pixels = frame.pixels.astype(float)
    level = np.median(pixels)
    v, u = np.unravel_index(np.argmin(pixels), pixels.shape)
    part = np.maximum(0.9 * level - pixels[v - 9 : v + 10, u - 9 : u + 10], 0.0)
    rows, columns = np.indices(part.shape)
    return np.array([(part * columns).sum(), (part * rows).sum()]) / part.sum() + [u - 9, v - 9]


def test_the_picture_shows_effects_and_not_commands(clock):
    upright = replace(ROBOT, tool=RobotTool(approach_angle=np.pi / 2))
    play = AxisEffect(axis="x", id="backlash", parameters={"width": 2e-6})
    bench = Bench(clock, replace(upright, effects=(play,)))
    bench.driver.open()
    for x in (0.0276, 0.0275):
        bench.settle(x=x)
    spot_px = find_spot_centre(bench.camera.grab(1.0))
    optics = bench.camera.scene.optics
    commanded = np.array([0.0275, *bench.driver.true_positions[1:]])
    chain = KinematicChain.of(upright)
    commanded_px = optics.pixel_of(compute_tip_position(chain, commanded))
    np.testing.assert_allclose(spot_px, optics.pixel_of(true_tip_position(bench.driver)), atol=0.15)
    assert abs(spot_px[0] - commanded_px[0]) > 1.0  # px, backlash


def test_the_cell_is_drawn_at_the_contact_of_the_tip(clock):
    bench = Bench(clock)
    bench.driver.open()
    bench.camera.grab(1.0)
    initial_cell = bench.camera.scene.cell
    lower_limit = ROBOT.axes["zn"].range[0]
    position = bench.driver.true_positions[bench.driver.axes.index("zn")]
    values = {"place": position - lower_limit - 5e-6, "stiffness": -0.1}
    bench.driver.set_effects((AxisEffect(axis="zn", id="contact", parameters=values),))
    bench.camera.grab(1.0)
    cell = bench.camera.scene.cell
    assert cell.radius_ratio_at(true_tip_position(bench.driver)) > 1.05
    bench.settle(zn=position - 4.9e-6)
    # The cell is 5 µm ahead of the tip.
    assert cell.radius_ratio_at(true_tip_position(bench.driver)) == pytest.approx(1.0, abs=0.02)
    assert bench.camera.grab(1.0).metadata["pierced"] is False
    bench.driver.set_effects(())
    bench.camera.grab(1.0)
    # The cell at the tip is taken away.
    assert bench.camera.scene.cell == initial_cell

    bench.driver.set_effects((AxisEffect(axis="zn", id="contact", parameters=values),))
    bench.settle(zn=position - 7e-6)
    bench.camera.grab(1.0)
    # The effect ends while the tip is inside, so the membrane is pierced.
    bench.driver.set_effects(())
    assert bench.camera.grab(1.0).metadata["pierced"] is True
    assert bench.camera.scene.cell != initial_cell


def test_the_true_position_comes_from_the_plant_and_can_be_read_after_closing(clock):
    driver = Simulator(ROBOT, clock=clock)
    assert driver.true_positions[:3] == (0.0275, 0.0275, 0.04)
    driver.open()
    driver.move_to({"x": 0.0276})
    clock.advance(2.0)
    driver.read()
    assert driver.true_positions[0] == pytest.approx(0.0276, abs=1e-9)
    driver.close()
    assert driver.true_positions[0] == pytest.approx(0.0276, abs=1e-9)


def test_a_disconnected_machine_stays_at_its_last_position(clock):
    bench = Bench(clock)
    bench.driver.open()
    bench.settle(x=0.02745)
    first_frame = bench.camera.grab(1.0)
    bench.driver = None
    second_frame = bench.camera.grab(1.0)
    assert abs(second_frame.pixels.astype(int) - first_frame.pixels.astype(int)).mean() < 40.0
    np.testing.assert_allclose(bench.camera._joints[0], 0.02745, atol=1e-8)
    # The same robot is connected again.
    bench.driver = Simulator(load_robot("rotemina"), clock=clock)
    assert bench.camera.grab(1.0) is not None


def test_only_a_simulated_machine_can_be_shown(clock):
    source = SimulatedMicroscope(lambda: None, clock=clock, wait=clock.advance)
    assert (source.devices(), source.problem) == ((), None)
    bench = Bench(clock)
    bench.camera.close()
    bench.driver = type("R", (), {"name": "real"})()
    assert bench.source.devices() == ()
    assert "real shows only a simulated machine" in bench.source.problem
    with pytest.raises(CameraLostError, match="connect the simulator"):
        bench.camera.open()


def test_a_change_of_robot_loses_the_camera(clock):
    bench = Bench(clock)
    bench.driver = Simulator(load_robot("fsm"), clock=clock)
    with pytest.raises(CameraLostError, match="close it and open it again"):
        bench.camera.grab(1.0)


def test_frames_come_at_their_rate_and_missed_frames_are_counted(clock):
    bench = Bench(clock)
    began_s = clock()
    frames = [bench.camera.grab(1.0) for _ in range(5)]
    assert clock() - began_s == pytest.approx(4 / 30.0)
    assert [frame.number for frame in frames] == [0, 1, 2, 3, 4]
    clock.advance(10.5 / 30.0)
    late_frame = bench.camera.grab(1.0)
    assert (late_frame.number, late_frame.lost) == (14, 9)
    bench.camera.configure(CameraSettings(exposure_s=0.5))
    bench.camera.grab(1.0)
    before_s = clock()
    bench.camera.grab(1.0)
    assert clock() - before_s == pytest.approx(0.5)


def test_exposure_and_gain_brighten_the_picture(clock):
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


def test_the_focus_drive_blurs_the_picture_within_its_range(clock):
    bench = Bench(clock)
    sharp_step = np.abs(np.diff(bench.camera.grab(1.0).pixels[505:525, 655].astype(float))).max()
    bench.camera.move_focus(40e-6)
    frame = bench.camera.grab(1.0)
    assert frame.metadata["focus_m"] == bench.camera.focus_m == 40e-6
    assert np.abs(np.diff(frame.pixels[505:525, 655].astype(float))).max() < 0.6 * sharp_step
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
    offset_m = np.array(centre) - true_tip_position(bench.driver)
    bench.settle(y=joints[1] + offset_m[1])
    assert not bench.camera.grab(1.0).metadata["pierced"]
    bench.settle(x=joints[0] + offset_m[0])
    assert bench.camera.grab(1.0).metadata["pierced"]
    bench.settle(x=joints[0])
    assert bench.camera.grab(1.0).metadata["pierced"]
    bench.camera.replace_cell()
    assert not bench.camera.grab(1.0).metadata["pierced"]


def test_the_same_seed_gives_the_same_frames(clock):
    first, same_seed, other_seed = (
        Bench(clock, seed=seed).camera.grab(1.0).pixels for seed in (3, 3, 4)
    )
    np.testing.assert_array_equal(first, same_seed)
    assert (first != other_seed).mean() > 0.9
