"""A scene made into pictures: what stays is prepared once, and only what moves is drawn again."""

from dataclasses import replace

import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray
from rotemina.sim.microscope import kernels
from rotemina.sim.microscope.cell import UNTOUCHED, Cell, CellState
from rotemina.sim.microscope.cell_image import CellImage, draw_cell
from rotemina.sim.microscope.kernels import Image, Numbers
from rotemina.sim.microscope.pin_image import draw_pin
from rotemina.sim.microscope.scene import Light, Scene

EXPOSURE_S = 0.02
_NOISE = 1 << 18  # length of the sequence in which every row's noise begins somewhere
_DUST_PX = 25  # the dust's softness


class Renderer:
    """Draws the pictures of one scene; used by one thread.

    Parameters
    ----------
    scene : Scene
    """

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        optics, rng = scene.optics, np.random.default_rng(scene.seed)
        shape = (optics.height, optics.width)
        self._field = _illuminated(scene.light, shape, rng)
        self._grains = rng.standard_normal(shape, dtype=np.float32)
        self._noise = rng.standard_normal(_NOISE + optics.width, dtype=np.float32)
        self._still = self._field.copy()  # with the cell, without the pin
        self._light = np.empty_like(self._still)  # with the pin; new memory would cost as much
        self._drawn: CellImage | None = None
        self._known: tuple[CellState, float] | None = None

    def use_cell(self, cell: Cell | None) -> None:
        """Draw another cell, or none, from now on."""
        self._still[:] = self._field
        self.scene = replace(self.scene, cell=cell)
        self._drawn = self._known = None

    def light(
        self, tip_m: FloatArray, tool_axis: FloatArray, focus_m: float, state: CellState = UNTOUCHED
    ) -> Image:
        """Return the light on every pixel (height, width), over that of the lamp in the middle."""
        return self._lit(tip_m, tool_axis, focus_m, state).copy()

    def frame(
        self,
        tip_m: FloatArray,
        tool_axis: FloatArray,
        focus_m: float,
        rng: np.random.Generator,
        state: CellState = UNTOUCHED,
        *,
        exposure_s: float = EXPOSURE_S,
        gain: float = 1.0,
    ) -> Numbers:
        """Return a picture (height, width).

        Parameters
        ----------
        tip_m, tool_axis : (3,)
            Of the kinematics: where the tip is, m, and the unit vector from it to the pivot.
        focus_m : float
            Depth of the focal plane behind the scene's centre, along the view, m.
        rng : Generator
            Of the noise.
        state : CellState
            What the tip has done to the cell.
        exposure_s, gain : float
        """
        return self.exposed(self._lit(tip_m, tool_axis, focus_m, state), rng, exposure_s, gain)

    def exposed(
        self, light: Image, rng: np.random.Generator, exposure_s: float, gain: float
    ) -> Numbers:
        """Return what the camera makes of ``light`` (height, width)."""
        sensor = self.scene.sensor
        begins = np.asarray(rng.integers(0, _NOISE, size=light.shape[0]))
        return kernels.expose(
            light,
            self._noise,
            begins,
            np.float32(self.scene.light.rate * exposure_s),
            np.float32(sensor.full_well),
            np.float32(sensor.read_noise**2),
            np.float32(gain / sensor.electrons_per_number),
            np.float32(sensor.black_level),
            np.float32(sensor.largest),
        )

    def _lit(
        self, tip_m: FloatArray, tool_axis: FloatArray, focus_m: float, state: CellState
    ) -> Image:
        """Return the light; the next picture overwrites it."""
        self._draw_still(state, focus_m)
        np.copyto(self._light, self._still)
        draw_pin(self._light, self.scene.optics, self.scene.pin, tip_m, tool_axis, focus_m)
        return self._light

    def _draw_still(self, state: CellState, focus_m: float) -> None:
        """Draw the cell again if it, or the focal plane, has changed."""
        cell = self.scene.cell
        seen = CellState(state.tip_m if state.entry_m else None, state.entry_m, state.hole_m)
        if cell is None or self._known == (seen, focus_m):
            return
        if self._drawn is not None:
            at = self._drawn.rows, self._drawn.columns
            self._still[at] = self._field[at]
        self._drawn = draw_cell(self.scene.optics, cell, seen, focus_m, self._grains)
        if self._drawn is not None:
            self._still[self._drawn.rows, self._drawn.columns] *= self._drawn.passed
        self._known = (seen, focus_m)


def _illuminated(light: Light, shape: tuple[int, int], rng: np.random.Generator) -> Image:
    """Return the empty field (shape): 1 in the middle, but for dust."""
    height, width = shape
    down = np.linspace(-1.0, 1.0, height)[:, None]
    across = np.linspace(-1.0, 1.0, width)[None]
    field = 1.0 - light.vignetting * (across**2 + down**2) / 2.0
    field = field + 0.5 * (light.gradient[0] * across + light.gradient[1] * down)
    coarse = (height // _DUST_PX + 3, width // _DUST_PX + 3)
    dust = scipy.ndimage.zoom(
        scipy.ndimage.gaussian_filter(rng.standard_normal(coarse), 0.7), _DUST_PX, order=1
    )
    field = field * (1.0 + light.dust * dust[:height, :width])
    return np.maximum(field, 0.0).astype(np.float32)
