"""Solids as faces and edges, for a viewer that draws by itself.

A mesh is made of the command that three.js would draw, so that both show the same. Every solid here
is convex, and an open tube is the side of a convex one.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np

from rotemina.app.scene.scene import Command
from rotemina.sim.arrays import BoolArray, FloatArray, IntArray

_TUBE, _RING, _BELTS = 24, 16, 10  # faces around a tube, around an ellipsoid, and from pole to pole
_SHARP = 0.8  # cosine between the normals at an edge, below which the edge is drawn

Faces = list[list[int]]


@dataclass(frozen=True, slots=True)
class Mesh:
    """Points (n, 3), m, and what joins them.

    Attributes
    ----------
    faces : points of each face, in turn.
    normals : (f, 3), unit vectors that point outwards.
    edges, sides : (e, 2), the points and the faces of each edge; an open edge has one face twice.
    sharp : (e,), where the faces of an edge meet at an angle; open edges are sharp.
    """

    points: FloatArray
    faces: Faces
    normals: FloatArray
    edges: IntArray
    sides: IntArray
    sharp: BoolArray


def mesh_of(command: Command) -> Mesh:
    """Return the mesh of a ``set_object`` command, in the frame of its path."""
    told = command["object"]
    (geometry,) = told["geometries"]
    points, faces = _MAKERS[geometry["type"]](geometry)
    matrix = np.array(told["object"]["matrix"]).reshape(4, 4).T
    points = points @ matrix[:3, :3].T + matrix[:3, 3]
    normals, middles = _planes(points, faces)
    outwards = middles - points.mean(axis=0)
    normals[np.einsum("ij,ij->i", normals, outwards) < 0] *= -1.0
    edges, sides = _edges(tuple(map(tuple, faces)))
    cosines = np.einsum("ij,ij->i", normals[sides[:, 0]], normals[sides[:, 1]])
    sharp = (cosines < _SHARP) | (sides[:, 0] == sides[:, 1])
    return Mesh(points, faces, normals, edges, sides, sharp)


def _planes(points: FloatArray, faces: Faces) -> tuple[FloatArray, FloatArray]:
    """Return unit normals (f, 3) of plane polygons, by Newell's method, and their middles (f, 3).

    Faces with the same number of corners are worked out together.
    """
    normals, middles = np.empty((len(faces), 3)), np.empty((len(faces), 3))
    counts = np.array([len(face) for face in faces])
    for count in np.unique(counts):
        chosen = np.flatnonzero(counts == count)
        corners = points[np.array([faces[at] for at in chosen])]
        relative = corners - corners[:, :1]  # less cancellation than about a far origin
        areas = np.cross(relative, np.roll(relative, -1, axis=1)).sum(axis=1)
        normals[chosen] = areas / np.linalg.norm(areas, axis=1, keepdims=True)
        middles[chosen] = corners.mean(axis=1)
    return normals, middles


@lru_cache(maxsize=8)
def _edges(faces: tuple[tuple[int, ...], ...]) -> tuple[IntArray, IntArray]:
    """Return edges and sides of faces; of one kind of solid they are always the same."""
    met: dict[tuple[int, int], list[int]] = {}
    for index, face in enumerate(faces):
        for one, other in zip(face, face[1:] + face[:1], strict=True):
            met.setdefault((min(one, other), max(one, other)), []).append(index)
    sides = [(found[0], found[-1]) for found in met.values()]
    return np.array(list(met)), np.array(sides)


def _box(sizes: Mapping[str, Any]) -> tuple[FloatArray, Faces]:
    half = np.array([sizes["width"], sizes["height"], sizes["depth"]]) / 2
    signs = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    faces = [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]]
    return signs * half, faces


def _cylinder(sizes: Mapping[str, Any]) -> tuple[FloatArray, Faces]:
    angles = np.arange(_TUBE) * 2 * np.pi / _TUBE
    ring = np.column_stack([np.sin(angles), np.zeros(_TUBE), np.cos(angles)])
    rise = np.array([0.0, sizes["height"] / 2, 0.0])
    points = np.vstack([ring * sizes["radiusTop"] + rise, ring * sizes["radiusBottom"] - rise])
    after = [(at + 1) % _TUBE for at in range(_TUBE)]
    faces = [[at, after[at], after[at] + _TUBE, at + _TUBE] for at in range(_TUBE)]
    if not sizes["openEnded"]:
        faces += [list(range(_TUBE)), list(range(_TUBE, 2 * _TUBE))]
    return points, faces


def _sphere(sizes: Mapping[str, Any]) -> tuple[FloatArray, Faces]:
    angles = np.arange(_RING) * 2 * np.pi / _RING
    heights = np.arange(1, _BELTS) * np.pi / _BELTS
    belts = [
        np.column_stack(
            [np.sin(h) * np.cos(angles), np.full(_RING, np.cos(h)), np.sin(h) * np.sin(angles)]
        )
        for h in heights
    ]
    points = np.vstack([*belts, [[0.0, 1.0, 0.0], [0.0, -1.0, 0.0]]]) * sizes["radius"]
    top, foot = len(points) - 2, len(points) - 1
    faces: Faces = []
    for at in range(_RING):
        after = (at + 1) % _RING
        for belt in range(0, (_BELTS - 2) * _RING, _RING):
            faces.append([belt + at, belt + after, belt + _RING + after, belt + _RING + at])
        last = (_BELTS - 2) * _RING
        faces += [[at, after, top], [last + at, last + after, foot]]
    return points, faces


_MAKERS: Mapping[str, Callable[[Mapping[str, Any]], tuple[FloatArray, Faces]]] = {
    "BoxGeometry": _box,
    "CylinderGeometry": _cylinder,
    "SphereGeometry": _sphere,
}
