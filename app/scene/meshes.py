"""Solids as faces and edges, for a viewer that draws without a GPU.

A mesh is made from the same command that three.js draws, so that both viewers show the same solids.
Every solid is convex, or is the side wall of a convex one (an open tube).
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np

from rotemina.app.scene.scene import SceneCommand
from rotemina.sim.arrays import (
    BoolArray,
    FloatArray,
    IntArray,
)

# Numbers of faces around a tube, around an ellipsoid, and from pole to pole of an ellipsoid.
_TUBE_SIDE_COUNT, _ELLIPSOID_SIDE_COUNT, _ELLIPSOID_BELT_COUNT = 24, 16, 10
# An edge is drawn if the cosine of the angle between the normals of its faces is smaller than this.
_MAX_SHARP_COSINE = 0.8

FaceList = list[list[int]]


@dataclass(frozen=True, slots=True)
class SolidMesh:
    """Surface of a solid.

    Attributes
    ----------
    points : (n, 3)
        Corners, m.
    faces : list of list of int
        Indices of the points around each face.
    normals : (f, 3)
        Unit vectors that point outwards.
    edges, edge_faces : (e, 2)
        Indices of the two points and the two faces of each edge. An open edge has the same face
        twice.
    is_sharp : (e,)
        Whether the two faces of an edge form a visible angle; true for open edges.
    """

    points: FloatArray
    faces: FaceList
    normals: FloatArray
    edges: IntArray
    edge_faces: IntArray
    is_sharp: BoolArray


def make_mesh(command: SceneCommand) -> SolidMesh:
    """Return the mesh of a ``set_object`` command, in the frame of its path."""
    scene_object = command["object"]
    (geometry,) = scene_object["geometries"]
    points, faces = _MESH_MAKERS[geometry["type"]](geometry)
    matrix = np.array(scene_object["object"]["matrix"]).reshape(4, 4).T
    points = points @ matrix[:3, :3].T + matrix[:3, 3]
    normals, centres = _compute_planes(points, faces)
    outward_directions = centres - points.mean(axis=0)
    normals[np.einsum("ij,ij->i", normals, outward_directions) < 0] *= -1.0
    edges, edge_faces = _find_edges(tuple(map(tuple, faces)))
    cosines = np.einsum("ij,ij->i", normals[edge_faces[:, 0]], normals[edge_faces[:, 1]])
    is_sharp = (cosines < _MAX_SHARP_COSINE) | (edge_faces[:, 0] == edge_faces[:, 1])
    return SolidMesh(points, faces, normals, edges, edge_faces, is_sharp)


def _compute_planes(points: FloatArray, faces: FaceList) -> tuple[FloatArray, FloatArray]:
    """Compute unit normals (f, 3) of plane polygons by Newell's method, and their centres (f, 3).

    Faces with the same number of corners are processed together, which is faster.
    """
    normals, centres = np.empty((len(faces), 3)), np.empty((len(faces), 3))
    corner_counts = np.array([len(face) for face in faces])
    for corner_count in np.unique(corner_counts):
        indices = np.flatnonzero(corner_counts == corner_count)
        corners = points[np.array([faces[index] for index in indices])]
        # Coordinates relative to the first corner reduce cancellation in the products.
        offsets = corners - corners[:, :1]
        areas = np.cross(offsets, np.roll(offsets, -1, axis=1)).sum(axis=1)
        normals[indices] = areas / np.linalg.norm(areas, axis=1, keepdims=True)
        centres[indices] = corners.mean(axis=1)
    return normals, centres


@lru_cache(maxsize=8)
def _find_edges(faces: tuple[tuple[int, ...], ...]) -> tuple[IntArray, IntArray]:
    """Return the edges of the faces (e, 2), and the two faces of each edge (e, 2).

    The result is cached, because all solids of a kind have the same faces.
    """
    faces_of_edge: dict[tuple[int, int], list[int]] = {}
    for index, face in enumerate(faces):
        for begin, end in zip(face, face[1:] + face[:1], strict=True):
            faces_of_edge.setdefault((min(begin, end), max(begin, end)), []).append(index)
    edge_faces = [(indices[0], indices[-1]) for indices in faces_of_edge.values()]
    return np.array(list(faces_of_edge)), np.array(edge_faces)


def _make_box_mesh(sizes: Mapping[str, Any]) -> tuple[FloatArray, FaceList]:
    half_sizes = np.array([sizes["width"], sizes["height"], sizes["depth"]]) / 2
    signs = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    faces = [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]]
    return signs * half_sizes, faces


def _make_cylinder_mesh(sizes: Mapping[str, Any]) -> tuple[FloatArray, FaceList]:
    angles = np.arange(_TUBE_SIDE_COUNT) * 2 * np.pi / _TUBE_SIDE_COUNT
    ring = np.column_stack([np.sin(angles), np.zeros(_TUBE_SIDE_COUNT), np.cos(angles)])
    half_axis = np.array([0.0, sizes["height"] / 2, 0.0])
    points = np.vstack(
        [ring * sizes["radiusTop"] + half_axis, ring * sizes["radiusBottom"] - half_axis]
    )
    next_index = [(index + 1) % _TUBE_SIDE_COUNT for index in range(_TUBE_SIDE_COUNT)]
    faces = [
        [index, next_index[index], next_index[index] + _TUBE_SIDE_COUNT, index + _TUBE_SIDE_COUNT]
        for index in range(_TUBE_SIDE_COUNT)
    ]
    if not sizes["openEnded"]:
        faces += [
            list(range(_TUBE_SIDE_COUNT)),
            list(range(_TUBE_SIDE_COUNT, 2 * _TUBE_SIDE_COUNT)),
        ]
    return points, faces


def _make_sphere_mesh(sizes: Mapping[str, Any]) -> tuple[FloatArray, FaceList]:
    angles = np.arange(_ELLIPSOID_SIDE_COUNT) * 2 * np.pi / _ELLIPSOID_SIDE_COUNT
    polar_angles = np.arange(1, _ELLIPSOID_BELT_COUNT) * np.pi / _ELLIPSOID_BELT_COUNT
    rings = [
        np.column_stack(
            [
                np.sin(polar_angle) * np.cos(angles),
                np.full(_ELLIPSOID_SIDE_COUNT, np.cos(polar_angle)),
                np.sin(polar_angle) * np.sin(angles),
            ]
        )
        for polar_angle in polar_angles
    ]
    points = np.vstack([*rings, [[0.0, 1.0, 0.0], [0.0, -1.0, 0.0]]]) * sizes["radius"]
    top, bottom = len(points) - 2, len(points) - 1
    faces: FaceList = []
    for index in range(_ELLIPSOID_SIDE_COUNT):
        next_index = (index + 1) % _ELLIPSOID_SIDE_COUNT
        for ring_start in range(
            0, (_ELLIPSOID_BELT_COUNT - 2) * _ELLIPSOID_SIDE_COUNT, _ELLIPSOID_SIDE_COUNT
        ):
            faces.append(
                [
                    ring_start + index,
                    ring_start + next_index,
                    ring_start + _ELLIPSOID_SIDE_COUNT + next_index,
                    ring_start + _ELLIPSOID_SIDE_COUNT + index,
                ]
            )
        last_ring = (_ELLIPSOID_BELT_COUNT - 2) * _ELLIPSOID_SIDE_COUNT
        faces += [[index, next_index, top], [last_ring + index, last_ring + next_index, bottom]]
    return points, faces


_MESH_MAKERS: Mapping[str, Callable[[Mapping[str, Any]], tuple[FloatArray, FaceList]]] = {
    "BoxGeometry": _make_box_mesh,
    "CylinderGeometry": _make_cylinder_mesh,
    "SphereGeometry": _make_sphere_mesh,
}
