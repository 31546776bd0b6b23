"""Small scenes of the simulated microscope with a known tip position."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.microscope import MicroscopeScene, SceneRenderer, TaperedPin
from rotemina.sim.microscope.optics import MicroscopeOptics
from rotemina.sim.vision import Pipette, to_grey

UPRIGHT = np.array([0.0, 0.0, 1.0])
OPTICS = MicroscopeOptics(width=520, height=420, rotation_rad=0.3, skew_rad=0.01, mirrored=True)


class SceneView:
    """A scene, its true projection, and the pipette for the tip finder."""

    def __init__(self, scene, direction_error=0.0, **pipette_options):
        self.scene, self.optics = scene, scene.optics
        self.renderer = SceneRenderer(scene)
        self.rng = np.random.default_rng(5)
        body_direction = scene.optics.mapping @ np.array([1.0, 0.0, 0.0])
        self.pipette = Pipette.from_optics(
            float(np.arctan2(body_direction[1], body_direction[0])) + direction_error,
            scene.optics.pixel_m,
            approach=scene.pin.approach_rad,
            aperture=scene.optics.aperture,
            **pipette_options,
        )

    def take_image(self, tip_m, focus_m=0.0, *state):
        return to_grey(
            self.renderer.render_frame(np.asarray(tip_m), UPRIGHT, focus_m, self.rng, *state)
        )

    def project(self, tip_m):
        return self.optics.pixel_of(np.asarray(tip_m))

    def draw_tip_position(self):
        return np.append(self.rng.uniform(-45e-6, 45e-6, 2), 0.0)


@pytest.fixture
def make_view():
    def make(direction_error=0.0, pin=None, cell=None, **optics):
        scene = MicroscopeScene(
            replace(OPTICS, **optics), pin or TaperedPin(approach_rad=np.pi / 6), cell
        )
        return SceneView(scene, direction_error)

    return make


@pytest.fixture
def view(make_view):
    return make_view()
