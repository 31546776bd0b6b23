"""Scenes of the simulated microscope whose truth is known, small enough to be drawn often."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.microscope.optics import Optics
from rotemina.sim.microscope.renderer import Renderer
from rotemina.sim.microscope.scene import Pin, Scene
from rotemina.sim.vision.image import grey
from rotemina.sim.vision.pipette import Pipette

UPRIGHT = np.array([0.0, 0.0, 1.0])
MOUNTED = Optics(width=520, height=420, rotation_rad=0.3, skew_rad=0.01, mirrored=True)


class View:
    """One scene, its truth, and the pipette as a finder would know it."""

    def __init__(self, scene, turned=0.0, **known):
        self.scene, self.optics = scene, scene.optics
        self.renderer = Renderer(scene)
        self.rng = np.random.default_rng(5)
        body = scene.optics.mapping @ np.array([1.0, 0.0, 0.0])
        self.pipette = Pipette.seen(
            float(np.arctan2(body[1], body[0])) + turned,
            scene.optics.pixel_m,
            approach=scene.pin.approach_rad,
            aperture=scene.optics.aperture,
            **known,
        )

    def image(self, tip_m, focus_m=0.0, *state):
        return grey(self.renderer.frame(np.asarray(tip_m), UPRIGHT, focus_m, self.rng, *state))

    def pixel(self, tip_m):
        return self.optics.pixel_of(np.asarray(tip_m))

    def anywhere(self):
        return np.append(self.rng.uniform(-45e-6, 45e-6, 2), 0.0)


@pytest.fixture
def make_view():
    def make(turned=0.0, pin=None, cell=None, **optics):
        scene = Scene(replace(MOUNTED, **optics), pin or Pin(approach_rad=np.pi / 6), cell)
        return View(scene, turned)

    return make


@pytest.fixture
def view(make_view):
    return make_view()
