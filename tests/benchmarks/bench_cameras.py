"""Cameras: how fast the simulated microscope draws, beside drawing all of it by whole frames.

``make bench`` runs it. The limit is 30 frames/s at 1300 × 1030 px on one core, with everything
switched on. The naive way blurs a sharp picture layer by layer with OpenCV and draws the noise of
every pixel with numpy. Processor time counts, which other work on the machine does not touch.
"""

import time
from itertools import pairwise

import cv2
import numpy as np
import pytest

from rotemina.app.cameras.frame_check import FrameCheck
from rotemina.drivers.cameras.frame import Frame, Region
from rotemina.drivers.cameras.simulated import SimulatedMicroscope
from rotemina.drivers.clock import VirtualClock
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.kinematics.chain import Chain
from rotemina.sim.kinematics.forward import tip_position, tool_axis
from rotemina.sim.microscope.cell import CellState, met
from rotemina.sim.microscope.pin_image import body_direction
from rotemina.sim.microscope.renderer import Renderer
from rotemina.sim.microscope.scene import Scene
from rotemina.sim.robot.file import load_robot

ROBOT = load_robot("rotemina")
FRAMES = 60
LEAST_HZ = 30.0
LAYERS = 12  # of equal depth into which the naive way cuts the pin
QUICK = {"FRAMES": 2, "LEAST_HZ": 0.0}


def per_frame_ms(draw, frames=FRAMES):
    """Return the processor time of a frame: the median, and the 99th percentile."""
    draw(0)
    spent = []
    for number in range(frames):
        before = time.process_time()
        draw(number)
        spent.append(1e3 * (time.process_time() - before))
    return np.median(spent), np.percentile(spent, 99)


def naive_frame(scene, field, tip, axis, rng):
    """Draw the pin as layers of depth, each blurred over the whole frame, and noise everywhere."""
    optics, pin = scene.optics, scene.pin
    body = body_direction(pin, axis)
    way, at = optics.mapping @ body, optics.pixel_of(tip)
    rows, columns = np.indices(field.shape, dtype=np.float32)
    scale = np.hypot(*way)
    along = ((columns - at[0]) * way[0] + (rows - at[1]) * way[1]) / scale**2  # m of the body
    across = np.abs((rows - at[1]) * way[0] - (columns - at[0]) * way[1]) / scale
    wide = (pin.tip_radius_m + pin.taper * along) / optics.pixel_m
    covered = pin.wall * (across < wide) - pin.lumen * (across < pin.bore * wide)
    edges = np.linspace(0.0, along.max(), LAYERS + 1)
    light = field.copy()
    for near, far in pairwise(edges):
        layer = np.where((along >= near) & (along < far), covered, 0.0)
        depth = 0.5 * (near + far) * float(body @ optics.view[2])
        blur = float(optics.blur_px(depth))
        light *= 1.0 - cv2.GaussianBlur(layer.astype(np.float32), (0, 0), blur)
    electrons = rng.poisson(light * 1e4) + rng.normal(0.0, 8.0, field.shape)
    return np.clip(electrons / 4.0 + 40.5, 0, 4095).astype(np.uint16)


@pytest.mark.parametrize(
    ("name", "mounting"), [("below", {}), ("inclined", {"axis": (0.0, 0.9, 0.45)})]
)
def test_drawing_a_frame(name, mounting):
    scene, chain = Scene.of(ROBOT, **mounting), Chain.of(ROBOT)
    drawn, rng = Renderer(scene), np.random.default_rng(1)
    tip, axis = tip_position(chain, chain.centre), tool_axis(chain.centre)
    still, _ = per_frame_ms(lambda number: drawn.frame(tip + number * 1e-7, axis, 0.0, rng))

    edge = np.array(scene.cell.centre_m) + np.array([scene.cell.radii_m[0], 0.0, 0.0])
    start = CellState(tip_m=tuple(edge + np.array([20e-6, 0.0, 0.0])))

    def push(number):  # the cell is drawn anew in every frame
        pushed = edge - np.array([1e-6 + 4e-8 * number, 0.0, 0.0])
        drawn.frame(pushed, axis, 0.0, rng, met(scene.cell, start, pushed))

    contact, worst = per_frame_ms(push)
    field = drawn.light(tip + 1e-2, axis, 0.0)
    naive, _ = per_frame_ms(lambda _: naive_frame(scene, field, tip, axis, rng), frames=3)
    print(
        f"\n{name}: {still:.1f} ms a frame, in contact {contact:.1f} (99 % {worst:.1f}), "
        f"naive {naive:.0f}"
    )
    assert 1e3 / contact > LEAST_HZ


def test_a_frame_from_the_simulator_to_its_watch():
    clock = VirtualClock()
    driver = Simulator(ROBOT, clock=clock)
    driver.open()
    source = SimulatedMicroscope(lambda: driver, clock=clock, wait=clock.advance)
    camera = source.camera(source.devices()[0])
    camera.open()
    watch = FrameCheck()

    def grab(_):
        frame = camera.grab(1.0)
        watch.judge(frame)

    whole, worst = per_frame_ms(grab)
    frame = Frame(np.zeros((1030, 1300), np.uint16), 0.0, 0, 12, Region(0, 0, 1300, 1030))
    alone, _ = per_frame_ms(lambda _: watch.judge(frame))
    print(
        f"\nfrom true positions to a judged frame: {whole:.1f} ms (99 % {worst:.1f}), "
        f"{alone:.1f} of it to judge"
    )
    assert 1e3 / whole > LEAST_HZ
