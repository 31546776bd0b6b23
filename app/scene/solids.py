"""Solids as three.js reads them: shape, pose and appearance."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from rotemina.app.scene.scene import Command
from rotemina.sim.arrays import FloatArray

Point = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Shape:
    """A three.js geometry; ``upright`` shapes turn about z here, about y there."""

    kind: str
    sizes: Mapping[str, Any]
    upright: bool = False
    stretch: Point = (1.0, 1.0, 1.0)


@dataclass(frozen=True, slots=True)
class Look:
    """Colour ``#rrggbb`` and opacity.

    A ``veil`` is drawn over what is at the same place and hides nothing: of two ghosts at one
    place both are seen.
    """

    colour: str
    opacity: float = 1.0
    veil: bool = False


@dataclass(frozen=True, slots=True)
class Solid:
    """A shape about a point of its frame, m."""

    shape: Shape
    middle: Point = (0.0, 0.0, 0.0)
    look: Look = field(default_factory=lambda: Look("#8b95a5"))


def box(width: float, depth: float, height: float) -> Shape:
    """Return a box with sides along x, y, z, m."""
    return Shape("BoxGeometry", {"width": width, "height": depth, "depth": height})


def tube(radius: float, height: float, *, foot: float | None = None, open_: bool = False) -> Shape:
    """Return an upright cylinder, m; ``foot`` is another radius at its lower end."""
    sizes = {
        "radiusTop": radius,
        "radiusBottom": radius if foot is None else foot,
        "height": height,
        "radialSegments": 48,
        "heightSegments": 1,
        "openEnded": open_,
    }
    return Shape("CylinderGeometry", sizes, upright=True)


def ellipsoid(radii: Point) -> Shape:
    """Return an ellipsoid with half axes along x, y, z, m."""
    sizes = {"radius": 1.0, "widthSegments": 32, "heightSegments": 24}
    return Shape("SphereGeometry", sizes, stretch=radii)


def set_object(path: str, solid: Solid) -> Command:
    """Draw a solid at ``path``."""
    material = {
        "uuid": f"{path}:material",
        "type": "MeshLambertMaterial",
        "color": int(solid.look.colour.removeprefix("#"), 16),
        "side": 2,
        "transparent": solid.look.opacity < 1.0,
        "opacity": solid.look.opacity,
        "depthWrite": not solid.look.veil,
        # Pushed back a little: a veil at the very same place is then drawn over it.
        "polygonOffset": not solid.look.veil,
        "polygonOffsetFactor": 1.0,
        "polygonOffsetUnits": 1.0,
    }
    geometry = {
        "uuid": f"{path}:geometry",
        "type": solid.shape.kind,
        **solid.shape.sizes,
    }
    drawn = {
        "uuid": path,
        "type": "Mesh",
        "geometry": geometry["uuid"],
        "material": material["uuid"],
        "renderOrder": int(solid.look.veil),  # over what it must not hide
        "matrix": _placement(solid).T.ravel().tolist(),
    }
    scene = {"metadata": {"version": 4.5, "type": "Object"}, "object": drawn}
    lists = {"geometries": [geometry], "materials": [material]}
    return {"type": "set_object", "path": path, "object": {**scene, **lists}}


def _placement(solid: Solid) -> FloatArray:
    """Return the matrix (4, 4) from three.js' shape to the frame of the solid."""
    matrix = np.eye(4)
    if solid.shape.upright:  # y of the shape is z of the frame
        matrix[:3, :3] = [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]
    matrix[:3, :3] *= np.array(solid.shape.stretch)
    matrix[:3, 3] = solid.middle
    return matrix
