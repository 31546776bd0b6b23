"""A scene as polygons and lines in pixels, for a viewer that draws without a GPU."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from rotemina.app.scene.camera import SceneCamera, compute_focal_length_px, project_to_pixels
from rotemina.app.scene.meshes import SolidMesh, make_mesh
from rotemina.app.scene.painter_order import find_painting_order
from rotemina.app.scene.scene import SceneCommand
from rotemina.sim.arrays import (
    BoolArray,
    FloatArray,
    IntArray,
)

# Direction towards the light in camera coordinates.
_LIGHT_DIRECTION = np.array([-0.45, 0.6, -0.66])
_MIN_SHADE = 0.45
_NO_LINES = np.empty((0, 4))
# Solids are clipped to a rectangle larger than the picture, so that clipped edges are not visible.
_CLIP_MARGIN_RATIO = 1.1

Polygon = list[list[float]]
# Faces, shades and lines of a solid.
_ClippedSolid = tuple[list[Polygon], list[float], FloatArray]


@dataclass(frozen=True, slots=True)
class ProjectedSolid:
    """A solid in the form in which it is painted.

    Attributes
    ----------
    path : str
        Path in the scene.
    colour, opacity, is_veil
        See :class:`rotemina.app.scene.solids.SolidAppearance`.
    faces : sequence of polygons
        Corners x, y of each visible face, px.
    shades : sequence of float
        Brightness of each face, 0 to 1.
    lines : (m, 4)
        Lines of the sharp edges and the silhouette: x, y of the start and x, y of the end, px.
    """

    path: str
    colour: str
    opacity: float
    is_veil: bool
    faces: Sequence[Polygon]
    shades: Sequence[float]
    lines: FloatArray


@dataclass(frozen=True, slots=True)
class _SceneObject:
    mesh: SolidMesh
    colour: str
    opacity: float
    is_veil: bool


class ProjectedPicture:
    """The scene that results from its commands; projects the solids for painting."""

    def __init__(self) -> None:
        self.camera: SceneCamera | None = None
        self.home_camera: SceneCamera | None = None
        self.note: SceneCommand = {"warnings": (), "shown": (), "old": False}
        self.background = (0.0, 0.0, 0.0)
        self._objects: dict[str, _SceneObject] = {}
        self._poses: dict[str, FloatArray] = {}
        self._hidden_paths: set[str] = set()
        # The visible solids; None after a change, until the next projection.
        self._batch: _SolidBatch | None = None

    def apply_command(self, command: SceneCommand) -> None:
        """Apply one command; unknown commands are ignored, as in the browser."""
        kind, path = command["type"], command.get("path", "")
        if kind == "set_object":
            material = command["object"]["materials"][0]
            colour, is_veil = f"#{material['color']:06x}", not material["depthWrite"]
            self._objects[path] = _SceneObject(
                make_mesh(command), colour, material["opacity"], is_veil
            )
            self._batch = None
        elif kind == "set_transform":
            self._poses[path] = np.array(command["matrix"]).reshape(4, 4).T
        elif kind == "view":
            self.camera = self.home_camera = SceneCamera.from_command(command)
        elif kind == "note":
            self.note = command
        elif kind == "set_property" and command["property"] == "visible":
            (self._hidden_paths.discard if command["value"] else self._hidden_paths.add)(path)
            self._batch = None
        elif kind == "set_property" and command["property"] == "top_color":
            self.background = command["value"]

    def project_solids(self, width: float, height: float) -> list[ProjectedSolid]:
        """Project the visible solids to a picture of this size, px, in the order of painting."""
        camera, batch = self.camera, self._get_visible_batch()
        if camera is None or not batch.paths:
            return []
        points, normals = batch.to_scene_coordinates(self._compute_pose)
        low = np.minimum.reduceat(points, batch.starts)
        high = np.maximum.reduceat(points, batch.starts)
        clipper = _PictureClipper(width, height, camera.near_m)
        clipped_solids = clipper.clip(
            batch, camera.to_camera_frame(points), normals @ camera.axes.T
        )
        projected_solids = []
        for index in find_painting_order(low, high, camera.eye, batch.is_veil):
            scene_object, (faces, shades, lines) = batch.objects[index], clipped_solids[index]
            if faces or len(lines):
                appearance = (scene_object.colour, scene_object.opacity, scene_object.is_veil)
                projected_solids.append(
                    ProjectedSolid(batch.paths[index], *appearance, faces, shades, lines)
                )
        return projected_solids

    def _get_visible_batch(self) -> "_SolidBatch":
        if self._batch is None:
            hidden_paths = self._hidden_paths
            paths = [
                path
                for path in self._objects
                if not hidden_paths.intersection(_list_ancestors(path))
            ]
            self._batch = _SolidBatch({path: self._objects[path] for path in paths})
        return self._batch

    def _compute_pose(self, path: str) -> FloatArray:
        """Compute the pose (4, 4) of a solid in scene coordinates."""
        pose = np.eye(4)
        for ancestor in _list_ancestors(path):
            if ancestor in self._poses:
                pose = pose @ self._poses[ancestor]
        return pose


class _SolidBatch:
    """Several solids, whose points, faces and edges are concatenated into one array each.

    ``starts`` are the indices of the first point of each solid; ``face_ends`` and ``edge_ends`` the
    indices after its last face and edge. ``corners`` is one point of each face. ``owners`` and
    ``face_owners`` are the solids to which each point and each face belongs.
    """

    def __init__(self, objects: Mapping[str, _SceneObject]) -> None:
        self.paths, self.objects = list(objects), list(objects.values())
        meshes = [scene_object.mesh for scene_object in self.objects]
        self.is_veil = np.array([scene_object.is_veil for scene_object in self.objects], dtype=bool)
        point_counts = [len(mesh.points) for mesh in meshes]
        self.starts = np.cumsum([0, *point_counts])[:-1]
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
        self.edge_faces = np.vstack(
            [mesh.edge_faces + first for mesh, first in zip(meshes, first_faces, strict=True)]
        )
        self.is_sharp = np.concatenate([mesh.is_sharp for mesh in meshes])
        indices = np.arange(len(meshes))
        self.owners = np.repeat(indices, point_counts)
        self.face_owners = np.repeat(indices, [len(mesh.faces) for mesh in meshes])

    def to_scene_coordinates(
        self, compute_pose: Callable[[str], FloatArray]
    ) -> tuple[FloatArray, FloatArray]:
        """Return points (n, 3), m, and normals (f, 3) in scene coordinates."""
        if not self.paths:
            return np.empty((0, 3)), np.empty((0, 3))
        poses = np.array([compute_pose(path) for path in self.paths])
        rotations = poses[:, :3, :3]
        points = np.einsum("nij,nj->ni", rotations[self.owners], self._points)
        normals = np.einsum("nij,nj->ni", rotations[self.face_owners], self._normals)
        return points + poses[self.owners, :3, 3], normals


def _list_ancestors(path: str) -> Iterator[str]:
    """Return the paths from the top of the scene tree down to ``path`` itself."""
    names = path.split("/")
    return ("/".join(names[:depth]) for depth in range(2, len(names) + 1))


class _PictureClipper:
    def __init__(self, width: float, height: float, near_m: float) -> None:
        self._width, self._height = width, height
        half_width, half_height = (
            _CLIP_MARGIN_RATIO * size / (2 * compute_focal_length_px(height))
            for size in (width, height)
        )
        # A point is inside if normals · point >= limits for all five planes.
        self._normals = np.array(
            [
                [0, 0, 1.0],
                [1.0, 0, half_width],
                [-1.0, 0, half_width],
                [0, 1.0, half_height],
                [0, -1.0, half_height],
            ]
        )
        self._plane_limits = np.array([near_m, 0.0, 0.0, 0.0, 0.0])
        self._planes = list(zip(self._normals.tolist(), self._plane_limits.tolist(), strict=True))

    def clip(
        self, batch: _SolidBatch, points: FloatArray, normals: FloatArray
    ) -> list[_ClippedSolid]:
        """Return the visible faces, their shades, and the lines of every solid.

        ``points`` (n, 3), m, and ``normals`` (f, 3) are in camera coordinates.
        """
        plane_distances = points @ self._normals.T - self._plane_limits  # (n, 5)
        is_outside = np.any(
            np.logical_and.reduceat(plane_distances < 0, batch.starts, axis=0), axis=1
        )
        is_inside = np.logical_and.reduceat(np.all(plane_distances >= 0, axis=1), batch.starts)
        # The eye is the origin, so a face is turned towards it if this product is negative.
        is_facing = np.einsum("ij,ij->i", normals, points[batch.corners]) < 0
        is_facing &= ~is_outside[batch.face_owners]
        light = np.clip(normals @ _LIGHT_DIRECTION, 0.0, 1.0)
        shades = (_MIN_SHADE + (1 - _MIN_SHADE) * light).tolist()
        # Points behind the near plane cannot be projected; they are clipped below.
        near_m = self._plane_limits[0]
        points_in_front = np.column_stack([points[:, :2], np.maximum(points[:, 2], near_m)])
        projected_points = project_to_pixels(points_in_front, self._width, self._height).tolist()
        clipped_solids: list[_ClippedSolid] = [([], [], _NO_LINES) for _ in batch.paths]
        for index in np.flatnonzero(is_facing).tolist():
            owner, corners = int(batch.face_owners[index]), batch.faces[index]
            if is_inside[owner]:
                polygon = [projected_points[corner] for corner in corners]
            elif np.any(np.all(plane_distances[corners] < 0, axis=0)):
                continue
            else:
                polygon = self._clip_polygon(points[corners].tolist())
            if polygon:
                clipped_solids[owner][0].append(polygon)
                clipped_solids[owner][1].append(shades[index])
        has_facing_faces = is_facing[batch.edge_faces]  # (e, 2)
        is_silhouette = has_facing_faces[:, 0] != has_facing_faces[:, 1]
        is_shown = np.any(has_facing_faces, axis=1) & (batch.is_sharp | is_silhouette)
        shown_edges = np.flatnonzero(is_shown)
        is_in_picture, lines = self._clip_lines(points, plane_distances, batch.edges[shown_edges])
        line_ends = np.searchsorted(shown_edges[is_in_picture], batch.edge_ends)
        lines_of_solids = np.split(lines, line_ends[:-1])
        return [
            (*clipped_solid[:2], solid_lines)
            for clipped_solid, solid_lines in zip(clipped_solids, lines_of_solids, strict=True)
        ]

    def _clip_polygon(self, polygon: list[list[float]]) -> Polygon:
        """Clip a convex polygon of corners x, y, z, and project it to px (Sutherland-Hodgman)."""
        # For so few corners, plain numbers are faster than arrays.
        for (a, b, c), limit in self._planes:
            depths = [a * x + b * y + c * z - limit for x, y, z in polygon]
            if min(depths) >= 0:
                continue
            clipped = []
            for index, (point, depth) in enumerate(zip(polygon, depths, strict=True)):
                previous_point, previous_depth = polygon[index - 1], depths[index - 1]
                if (depth >= 0) != (previous_depth >= 0):
                    fraction = previous_depth / (previous_depth - depth)
                    pairs = zip(previous_point, point, strict=True)
                    clipped.append([begin + fraction * (end - begin) for begin, end in pairs])
                if depth >= 0:
                    clipped.append(point)
            if len(clipped) < 3:
                return []
            polygon = clipped
        scale, x_middle, y_middle = (
            compute_focal_length_px(self._height),
            self._width / 2,
            self._height / 2,
        )
        return [[x_middle + scale * x / z, y_middle - scale * y / z] for x, y, z in polygon]

    def _clip_lines(
        self, points: FloatArray, plane_distances: FloatArray, edges: IntArray
    ) -> tuple[BoolArray, FloatArray]:
        """Return which edges (e, 2) are in the picture (e,), and their clipped lines (m, 4), px.

        The algorithm is Liang-Barsky.
        """
        begin_depths, end_depths = plane_distances[edges[:, 0]], plane_distances[edges[:, 1]]
        begin, end = points[edges[:, 0]], points[edges[:, 1]]
        with np.errstate(divide="ignore", invalid="ignore"):
            # Where the edge crosses each plane, as a fraction of the edge.
            crossing = begin_depths / (begin_depths - end_depths)
        entry = np.max(np.where((begin_depths < 0) & (end_depths >= 0), crossing, 0.0), axis=1)
        exit_ = np.min(np.where((begin_depths >= 0) & (end_depths < 0), crossing, 1.0), axis=1)
        is_in_picture: BoolArray = ~np.any((begin_depths < 0) & (end_depths < 0), axis=1) & (
            entry < exit_
        )
        direction = (end - begin)[is_in_picture]
        entry_points = begin[is_in_picture] + entry[is_in_picture, None] * direction
        exit_points = begin[is_in_picture] + exit_[is_in_picture, None] * direction
        line_ends = [
            project_to_pixels(line_end, self._width, self._height)
            for line_end in (entry_points, exit_points)
        ]
        return is_in_picture, np.hstack(line_ends)
