"""Solids in the format of three.js: shape, pose and appearance."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from rotemina.app.scene.scene import SceneCommand
from rotemina.sim.arrays import FloatArray

Coordinates = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class SolidShape:
    """A geometry of three.js, with its class name ``kind`` and its parameters ``sizes``.

    The axis of symmetry of an ``is_upright`` shape is z in this program, but y in three.js.
    ``stretch`` scales the shape along x, y and z.
    """

    kind: str
    sizes: Mapping[str, Any]
    is_upright: bool = False
    stretch: Coordinates = (1.0, 1.0, 1.0)


@dataclass(frozen=True, slots=True)
class SolidAppearance:
    """Colour ``#rrggbb`` and opacity of a solid.

    A veil is drawn over solids at the same position and hides nothing, so that two ghosts at the
    same position are both visible.
    """

    colour: str
    opacity: float = 1.0
    is_veil: bool = False


@dataclass(frozen=True, slots=True)
class SceneSolid:
    """A shape with its appearance; ``centre_m`` is its centre in the frame of its path, m."""

    shape: SolidShape
    centre_m: Coordinates = (0.0, 0.0, 0.0)
    appearance: SolidAppearance = field(default_factory=lambda: SolidAppearance("#8b95a5"))


def make_box(width: float, depth: float, height: float) -> SolidShape:
    """Return a box with sides along x, y, z, m."""
    return SolidShape("BoxGeometry", {"width": width, "height": depth, "depth": height})


def make_tube(
    radius: float, height: float, *, foot_radius: float | None = None, open_: bool = False
) -> SolidShape:
    """Return an upright cylinder or cone, m; ``foot_radius`` is the radius of its lower end.

    An ``open_`` tube has no end faces.
    """
    sizes = {
        "radiusTop": radius,
        "radiusBottom": radius if foot_radius is None else foot_radius,
        "height": height,
        "radialSegments": 48,
        "heightSegments": 1,
        "openEnded": open_,
    }
    return SolidShape("CylinderGeometry", sizes, is_upright=True)


def make_ellipsoid(radii: Coordinates) -> SolidShape:
    """Return an ellipsoid with semi-axes along x, y, z, m."""
    sizes = {"radius": 1.0, "widthSegments": 32, "heightSegments": 24}
    return SolidShape("SphereGeometry", sizes, stretch=radii)


def set_object(path: str, solid: SceneSolid) -> SceneCommand:
    """Return the command that draws a solid at ``path``."""
    material = {
        "uuid": f"{path}:material",
        "type": "MeshLambertMaterial",
        "color": int(solid.appearance.colour.removeprefix("#"), 16),
        "side": 2,
        "transparent": solid.appearance.opacity < 1.0,
        "opacity": solid.appearance.opacity,
        "depthWrite": not solid.appearance.is_veil,
        # A solid is pushed back a little, so that a veil at the same position is drawn over it.
        "polygonOffset": not solid.appearance.is_veil,
        "polygonOffsetFactor": 1.0,
        "polygonOffsetUnits": 1.0,
    }
    geometry = {
        "uuid": f"{path}:geometry",
        "type": solid.shape.kind,
        **solid.shape.sizes,
    }
    mesh = {
        "uuid": path,
        "type": "Mesh",
        "geometry": geometry["uuid"],
        "material": material["uuid"],
        # Veils are drawn last.
        "renderOrder": int(solid.appearance.is_veil),
        "matrix": _make_matrix(solid).T.ravel().tolist(),
    }
    scene_object = {
        "metadata": {"version": 4.5, "type": "Object"},
        "object": mesh,
        "geometries": [geometry],
        "materials": [material],
    }
    return {"type": "set_object", "path": path, "object": scene_object}


def _make_matrix(solid: SceneSolid) -> FloatArray:
    """Return the matrix (4, 4) from the shape's frame in three.js to the frame of the solid."""
    matrix = np.eye(4)
    if solid.shape.is_upright:
        # The y axis of the shape becomes the z axis of the frame.
        matrix[:3, :3] = [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]
    matrix[:3, :3] *= np.array(solid.shape.stretch)
    matrix[:3, 3] = solid.centre_m
    return matrix
