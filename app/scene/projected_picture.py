"""A scene as polygons and lines in pixels, for a viewer that draws without a GPU."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from rotemina.app.scene.camera import Camera, focal, pixels
from rotemina.app.scene.meshes import Mesh, mesh_of
from rotemina.app.scene.painter_order import painter_order
from rotemina.app.scene.scene import Command
from rotemina.sim.arrays import BoolArray, FloatArray, IntArray

_LIGHT = np.array([-0.45, 0.6, -0.66])  # towards it, along the camera's axes
_DARKEST = 0.45
_NO_LINES = np.empty((0, 4))
_MARGIN = 1.1  # of the picture's size: what is cut off is cut outside

Polygon = list[list[float]]
_Cut = tuple[list[Polygon], list[float], FloatArray]  # faces, shades, lines of a solid


@dataclass(frozen=True, slots=True)
class Drawn:
    """A solid of the picture.

    Attributes
    ----------
    colour, opacity, veil : as in :class:`rotemina.app.scene.solids.Look`.
    faces : polygons, corners x, y in px.
    shades : brightness of each face, 0 to 1.
    lines : (m, 4), px: edges and silhouette, from x, y to x, y.
    """

    path: str
    colour: str
    opacity: float
    veil: bool
    faces: Sequence[Polygon]
    shades: Sequence[float]
    lines: FloatArray


@dataclass(frozen=True, slots=True)
class _Object:
    mesh: Mesh
    colour: str
    opacity: float
    veil: bool


class Picture:
    """Executes the commands of a scene, and provides the result for painting."""

    def __init__(self) -> None:
        self.camera: Camera | None = None
        self.home: Camera | None = None
        self.note: Command = {"warnings": (), "shown": (), "old": False}
        self.background = (0.0, 0.0, 0.0)
        self._objects: dict[str, _Object] = {}
        self._poses: dict[str, FloatArray] = {}
        self._hidden: set[str] = set()
        self._batch: _Batch | None = None  # of what is visible

    def obey(self, command: Command) -> None:
        """Take one command over; unknown ones are ignored, as by the page."""
        kind, path = command["type"], command.get("path", "")
        if kind == "set_object":
            material = command["object"]["materials"][0]
            colour, veil = f"#{material['color']:06x}", not material["depthWrite"]
            self._objects[path] = _Object(mesh_of(command), colour, material["opacity"], veil)
            self._batch = None
        elif kind == "set_transform":
            self._poses[path] = np.array(command["matrix"]).reshape(4, 4).T
        elif kind == "view":
            self.camera = self.home = Camera.of(command)
        elif kind == "note":
            self.note = command
        elif kind == "set_property" and command["property"] == "visible":
            (self._hidden.discard if command["value"] else self._hidden.add)(path)
            self._batch = None
        elif kind == "set_property" and command["property"] == "top_color":
            self.background = command["value"]

    def drawn(self, width: float, height: float) -> list[Drawn]:
        """Return the visible solids in the order of painting, in a picture of this size, px."""
        camera, batch = self.camera, self._visible()
        if camera is None or not batch.paths:
            return []
        points, normals = batch.placed(self._pose)
        low = np.minimum.reduceat(points, batch.starts)
        high = np.maximum.reduceat(points, batch.starts)
        frame = _Frame(width, height, camera.near)
        cut = frame.cut(batch, camera.seen(points), normals @ camera.axes.T)
        found = []
        for at in painter_order(low, high, camera.eye, batch.veil):
            one, (faces, shades, lines) = batch.objects[at], cut[at]
            if faces or len(lines):
                look = (one.colour, one.opacity, one.veil)
                found.append(Drawn(batch.paths[at], *look, faces, shades, lines))
        return found

    def _visible(self) -> "_Batch":
        if self._batch is None:
            hidden = self._hidden
            paths = [path for path in self._objects if not hidden.intersection(_above(path))]
            self._batch = _Batch({path: self._objects[path] for path in paths})
        return self._batch

    def _pose(self, path: str) -> FloatArray:
        """Return the matrix (4, 4) from the frame of a solid to the room."""
        pose = np.eye(4)
        for each in _above(path):
            if each in self._poses:
                pose = pose @ self._poses[each]
        return pose


class _Batch:
    """Solids in one array each of points, faces and edges."""

    def __init__(self, objects: Mapping[str, _Object]) -> None:
        self.paths, self.objects = list(objects), list(objects.values())
        meshes = [one.mesh for one in self.objects]
        self.veil = np.array([one.veil for one in self.objects], dtype=bool)
        counts = [len(mesh.points) for mesh in meshes]
        self.starts = np.cumsum([0, *counts])[:-1]
        self.faces = [
            [int(start) + corner for corner in face]
            for start, mesh in zip(self.starts, meshes, strict=True)
            for face in mesh.faces
        ]
        self.face_ends = np.cumsum([len(mesh.faces) for mesh in meshes])
        self.edge_ends = np.cumsum([len(mesh.edges) for mesh in meshes])
        if not meshes:
            return
        self._points = np.vstack([mesh.points for mesh in meshes])
        self._normals = np.vstack([mesh.normals for mesh in meshes])
        self.corners = np.array([face[0] for face in self.faces])
        self.edges = np.vstack(
            [mesh.edges + start for mesh, start in zip(meshes, self.starts, strict=True)]
        )
        first_faces = [0, *self.face_ends[:-1]]
        self.sides = np.vstack(
            [mesh.sides + first for mesh, first in zip(meshes, first_faces, strict=True)]
        )
        self.sharp = np.concatenate([mesh.sharp for mesh in meshes])
        numbers = np.arange(len(meshes))
        self.owners = np.repeat(numbers, counts)
        self.face_owners = np.repeat(numbers, [len(mesh.faces) for mesh in meshes])

    def placed(self, pose: Callable[[str], FloatArray]) -> tuple[FloatArray, FloatArray]:
        """Return points (n, 3), m, and normals (f, 3) in the room."""
        if not self.paths:
            return np.empty((0, 3)), np.empty((0, 3))
        poses = np.array([pose(path) for path in self.paths])
        turns = poses[:, :3, :3]
        points = np.einsum("nij,nj->ni", turns[self.owners], self._points)
        normals = np.einsum("nij,nj->ni", turns[self.face_owners], self._normals)
        return points + poses[self.owners, :3, 3], normals


def _above(path: str) -> Iterator[str]:
    """Give the paths from the root down to this one."""
    names = path.split("/")
    return ("/".join(names[:count]) for count in range(2, len(names) + 1))


class _Frame:
    """Cuts what is seen to the picture, and projects it."""

    def __init__(self, width: float, height: float, near: float) -> None:
        self._width, self._height = width, height
        wide, high = (_MARGIN * size / (2 * focal(height)) for size in (width, height))
        # A point is inside where normals · point >= least.
        self._normals = np.array(
            [[0, 0, 1.0], [1.0, 0, wide], [-1.0, 0, wide], [0, 1.0, high], [0, -1.0, high]]
        )
        self._least = np.array([near, 0.0, 0.0, 0.0, 0.0])
        self._planes = list(zip(self._normals.tolist(), self._least.tolist(), strict=True))

    def cut(self, batch: _Batch, seen: FloatArray, normals: FloatArray) -> list[_Cut]:
        """Return faces, shades and lines of every solid, as the camera sees points and normals."""
        inside = seen @ self._normals.T - self._least  # (n, 5)
        lost = np.any(np.logical_and.reduceat(inside < 0, batch.starts, axis=0), axis=1)
        whole = np.logical_and.reduceat(np.all(inside >= 0, axis=1), batch.starts)
        facing = np.einsum("ij,ij->i", normals, seen[batch.corners]) < 0
        facing &= ~lost[batch.face_owners]
        light = np.clip(normals @ _LIGHT, 0.0, 1.0)
        shades = (_DARKEST + (1 - _DARKEST) * light).tolist()
        ahead = np.column_stack([seen[:, :2], np.maximum(seen[:, 2], self._least[0])])
        drawn = pixels(ahead, self._width, self._height).tolist()
        found: list[_Cut] = [([], [], _NO_LINES) for _ in batch.paths]
        for index in np.flatnonzero(facing).tolist():
            owner, corners = int(batch.face_owners[index]), batch.faces[index]
            if whole[owner]:
                polygon = [drawn[at] for at in corners]
            elif np.any(np.all(inside[corners] < 0, axis=0)):
                continue
            else:
                polygon = self._cut(seen[corners].tolist())
            if polygon:
                found[owner][0].append(polygon)
                found[owner][1].append(shades[index])
        front = facing[batch.sides]
        shown = np.any(front, axis=1) & (batch.sharp | (front[:, 0] != front[:, 1]))
        numbers = np.flatnonzero(shown)
        kept, lines = self._lines(seen, inside, batch.edges[numbers])
        ends = np.searchsorted(numbers[kept], batch.edge_ends)
        parts = np.split(lines, ends[:-1])
        return [(*each[:2], part) for each, part in zip(found, parts, strict=True)]

    def _cut(self, polygon: list[list[float]]) -> Polygon:
        """Return the part of a convex polygon, x, y, z, in the picture, px (Sutherland-Hodgman)."""
        for (a, b, c), least in self._planes:  # plain numbers: arrays this small are slower
            depths = [a * x + b * y + c * z - least for x, y, z in polygon]
            if min(depths) >= 0:
                continue
            kept = []
            for at, (point, depth) in enumerate(zip(polygon, depths, strict=True)):
                before, other = polygon[at - 1], depths[at - 1]
                if (depth >= 0) != (other >= 0):
                    share = other / (other - depth)
                    pairs = zip(before, point, strict=True)
                    kept.append([one + share * (two - one) for one, two in pairs])
                if depth >= 0:
                    kept.append(point)
            if len(kept) < 3:
                return []
            polygon = kept
        scale, x_middle, y_middle = focal(self._height), self._width / 2, self._height / 2
        return [[x_middle + scale * x / z, y_middle - scale * y / z] for x, y, z in polygon]

    def _lines(
        self, seen: FloatArray, inside: FloatArray, edges: IntArray
    ) -> tuple[BoolArray, FloatArray]:
        """Return which edges (e, 2) are in the picture, and those parts, px (Liang-Barsky)."""
        one, other = inside[edges[:, 0]], inside[edges[:, 1]]
        begin, end = seen[edges[:, 0]], seen[edges[:, 1]]
        with np.errstate(divide="ignore", invalid="ignore"):
            at = one / (one - other)
        enter = np.max(np.where((one < 0) & (other >= 0), at, 0.0), axis=1)
        leave = np.min(np.where((one >= 0) & (other < 0), at, 1.0), axis=1)
        kept: BoolArray = ~np.any((one < 0) & (other < 0), axis=1) & (enter < leave)
        along = (end - begin)[kept]
        first = begin[kept] + enter[kept, None] * along
        last = begin[kept] + leave[kept, None] * along
        ends = [pixels(each, self._width, self._height) for each in (first, last)]
        return kept, np.hstack(ends)
