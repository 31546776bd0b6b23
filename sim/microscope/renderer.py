"""Rendering of a scene. Fixed parts are drawn once, and only moving parts are drawn again."""

from dataclasses import replace

import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray
from rotemina.sim.microscope import kernels
from rotemina.sim.microscope.cell import UNTOUCHED_CELL_STATE, CellState, SimulatedCell
from rotemina.sim.microscope.cell_image import CellImage, draw_cell
from rotemina.sim.microscope.kernels import Image, PixelValues
from rotemina.sim.microscope.pin_image import draw_pin
from rotemina.sim.microscope.scene import MicroscopeScene, SceneLighting

DEFAULT_EXPOSURE_S = 0.02
# Length of the noise sequence. The noise of each row begins at a random index in it.
_NOISE_LENGTH = 1 << 18
# Size of the dust grains. It is far larger than a pixel, so the dust looks out of focus.
_DUST_GRAIN_PX = 25


class SceneRenderer:
    """Renderer of one scene, for use by one thread.

    Parameters
    ----------
    scene : MicroscopeScene
    """

    def __init__(self, scene: MicroscopeScene) -> None:
        self.scene = scene
        optics, rng = scene.optics, np.random.default_rng(scene.seed)
        shape = (optics.height, optics.width)
        self._field = _make_empty_field(scene.light, shape, rng)
        self._grains = rng.standard_normal(shape, dtype=np.float32)
        self._noise = rng.standard_normal(_NOISE_LENGTH + optics.width, dtype=np.float32)
        # The picture with the cell and without the pin.
        self._light_without_pin = self._field.copy()
        # The picture with the pin. Allocating it anew would take as long as drawing.
        self._light = np.empty_like(self._light_without_pin)
        self._cell_image: CellImage | None = None
        self._drawn_state: tuple[CellState, float] | None = None

    def use_cell(self, cell: SimulatedCell | None) -> None:
        """Replace the cell, or remove it for None."""
        self._light_without_pin[:] = self._field
        self.scene = replace(self.scene, cell=cell)
        self._cell_image = self._drawn_state = None

    def render_light(
        self,
        tip_m: FloatArray,
        tool_axis: FloatArray,
        focus_m: float,
        state: CellState = UNTOUCHED_CELL_STATE,
    ) -> Image:
        """Return the light on every pixel (height, width), relative to the lamp in the middle."""
        return self._draw_light(tip_m, tool_axis, focus_m, state).copy()

    def render_frame(
        self,
        tip_m: FloatArray,
        tool_axis: FloatArray,
        focus_m: float,
        rng: np.random.Generator,
        state: CellState = UNTOUCHED_CELL_STATE,
        *,
        exposure_s: float = DEFAULT_EXPOSURE_S,
        gain: float = 1.0,
    ) -> PixelValues:
        """Return a picture (height, width).

        Parameters
        ----------
        tip_m, tool_axis : (3,)
            From the kinematics: position of the tip, m, and the unit vector from it to the pivot.
        focus_m : float
            Depth of the focal plane behind the scene's centre, along the view, m.
        rng : Generator
            Generator of the noise.
        state : CellState
            State of the cell after contacts with the tip.
        exposure_s, gain : float
        """
        return self.expose(
            self._draw_light(tip_m, tool_axis, focus_m, state), rng, exposure_s, gain
        )

    def expose(
        self, light: Image, rng: np.random.Generator, exposure_s: float, gain: float
    ) -> PixelValues:
        """Return the picture that the camera takes of ``render_light`` (height, width)."""
        sensor = self.scene.sensor
        begins = np.asarray(rng.integers(0, _NOISE_LENGTH, size=light.shape[0]))
        return kernels.expose(
            light,
            self._noise,
            begins,
            np.float32(self.scene.light.rate * exposure_s),
            np.float32(sensor.full_well),
            np.float32(sensor.read_noise**2),
            np.float32(gain / sensor.electrons_per_number),
            np.float32(sensor.black_level),
            np.float32(sensor.max_number),
        )

    def _draw_light(
        self, tip_m: FloatArray, tool_axis: FloatArray, focus_m: float, state: CellState
    ) -> Image:
        """Draw the light and return it. The next call overwrites the returned array."""
        self._draw_cell_if_changed(state, focus_m)
        np.copyto(self._light, self._light_without_pin)
        draw_pin(self._light, self.scene.optics, self.scene.pin, tip_m, tool_axis, focus_m)
        return self._light

    def _draw_cell_if_changed(self, state: CellState, focus_m: float) -> None:
        cell = self.scene.cell
        state_in_picture = CellState(
            state.tip_m if state.entry_m else None, state.entry_m, state.hole_m
        )
        if cell is None or self._drawn_state == (state_in_picture, focus_m):
            return
        if self._cell_image is not None:
            region = self._cell_image.rows, self._cell_image.columns
            self._light_without_pin[region] = self._field[region]
        self._cell_image = draw_cell(
            self.scene.optics, cell, state_in_picture, focus_m, self._grains
        )
        if self._cell_image is not None:
            self._light_without_pin[self._cell_image.rows, self._cell_image.columns] *= (
                self._cell_image.transmission
            )
        self._drawn_state = (state_in_picture, focus_m)


def _make_empty_field(
    light: SceneLighting, shape: tuple[int, int], rng: np.random.Generator
) -> Image:
    """Return the light (shape) without cell and pin, 1 in the middle except for dust."""
    height, width = shape
    down = np.linspace(-1.0, 1.0, height)[:, None]
    across = np.linspace(-1.0, 1.0, width)[None]
    field = 1.0 - light.vignetting * (across**2 + down**2) / 2.0
    field = field + 0.5 * (light.gradient[0] * across + light.gradient[1] * down)
    coarse_shape = (height // _DUST_GRAIN_PX + 3, width // _DUST_GRAIN_PX + 3)
    dust = scipy.ndimage.zoom(
        scipy.ndimage.gaussian_filter(rng.standard_normal(coarse_shape), 0.7),
        _DUST_GRAIN_PX,
        order=1,
    )
    field = field * (1.0 + light.dust * dust[:height, :width])
    return np.maximum(field, 0.0).astype(np.float32)
