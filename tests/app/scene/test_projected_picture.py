"""The picture drawn without a GPU: projection, painting order and clipping."""

from itertools import pairwise

import numpy as np
import pytest

from rotemina.app.scene import (
    GhostPositions,
    ProjectedPicture,
    RobotGhost,
    RobotScene,
    SceneCamera,
    SceneColours,
    SceneViewpoint,
)
from rotemina.app.scene.camera import project_to_pixels
from rotemina.app.scene.meshes import make_mesh
from rotemina.app.scene.painter_order import find_painting_order
from rotemina.app.scene.solids import (
    SceneSolid,
    SolidAppearance,
    make_box,
    make_ellipsoid,
    make_tube,
    set_object,
)
from rotemina.sim.kinematics import compute_tip_position
from rotemina.sim.robot_files import load_robot

WIDTH, HEIGHT = 800, 600
COLOURS = SceneColours("#1c2027", "#8b95a5", "#4c9be8", "#f0a35e", "#d93a3a")


def make_camera(target=(0.0, 0.0, 0.0), offset=(0.0, -1.0, 0.0)):
    return SceneCamera(np.array(target), np.array(offset), 0.02)


@pytest.fixture
def robot_scene():
    scene = RobotScene(load_robot("rotemina"), COLOURS, max_age_s=0.5)
    set_positions(scene)
    return scene


def set_positions(scene, **positions):
    centre = dict(zip(scene.chain.robot.axes, scene.chain.centre.tolist(), strict=True))
    scene.show_positions(GhostPositions(centre | positions, centre))


def make_picture(scene):
    picture = ProjectedPicture()
    for command in scene.scene.get_changes().commands:
        picture.apply_command(command)
    return picture


def test_known_points_project_to_their_pixels():
    (middle, right, above) = project_to_pixels(
        make_camera().to_camera_frame(np.array([[0, 0, 0], [0.1, 0, 0], [0, 0, 0.1]])),
        WIDTH,
        HEIGHT,
    )
    per_metre = HEIGHT / 2 / np.tan(np.radians(31))  # the vertical field of view is 62°
    assert middle == pytest.approx([400, 300])
    assert right == pytest.approx([400 + 0.1 * per_metre, 300])
    assert above == pytest.approx([400, 300 - 0.1 * per_metre])


def test_camera_orbits_zooms_and_pans():
    camera = make_camera((0.1, 0.2, 0.3))
    for orbited in (camera.orbit(0.7, 0.4), camera.orbit(0.0, 99.0)):
        assert orbited.to_camera_frame(camera.target[None])[0] == pytest.approx([0, 0, 1])
    assert camera.orbit(np.pi / 2, 0.0).offset == pytest.approx([1, 0, 0])
    assert camera.zoom(2.0).offset == pytest.approx([0, -0.5, 0])
    assert camera.zoom(2.0).near_m == pytest.approx(0.01)
    assert np.linalg.norm(camera.zoom(1e9).offset) > 0
    shifted = camera.pan(30, 20, HEIGHT)
    pixel = project_to_pixels(shifted.to_camera_frame(camera.target[None]), WIDTH, HEIGHT)[0]
    assert pixel == pytest.approx([400 - 30, 300 + 20])


@pytest.mark.parametrize(
    ("shape", "volume"),
    [
        (make_box(1, 2, 3), 6.0),
        (make_tube(1, 2), 2 * np.pi),
        (make_tube(1, 3, foot_radius=1e-6), np.pi),
        (make_ellipsoid((1, 2, 3)), 8 * np.pi),
    ],
)
def test_faces_enclose_the_solid_and_their_normals_point_outwards(shape, volume):
    mesh = make_mesh(
        set_object("/a", SceneSolid(shape, (5.0, 6.0, 7.0), SolidAppearance("#ffffff")))
    )
    assert np.linalg.norm(mesh.normals, axis=1) == pytest.approx(1)
    enclosed_volume = 0.0  # by the divergence theorem
    for face, normal in zip(mesh.faces, mesh.normals, strict=True):
        first, *others = mesh.points[face] - [5.0, 6.0, 7.0]
        for second, third in pairwise(others):
            area = np.linalg.norm(np.cross(second - first, third - first)) / 2
            enclosed_volume += area * (first @ normal) / 3
    assert enclosed_volume == pytest.approx(volume, rel=0.08)
    assert enclosed_volume < volume * (1 + 1e-9)  # the facets lie inside round solids


def test_nearer_solid_is_painted_later_and_veil_after_the_solid_it_overlaps():
    low = np.array([[0, 0, 0], [0, 0, 1], [0, 0, 2], [0, 0, 1.0]])
    is_veil = np.array([False, False, False, True])
    above, below = np.array([0.5, 0.5, 9.0]), np.array([0.5, 0.5, -9.0])
    assert find_painting_order(low, low + 1, above, is_veil) == [0, 1, 3, 2]
    assert find_painting_order(low, low + 1, below, is_veil) == [2, 1, 3, 0]


def test_large_plate_below_does_not_cover_a_small_box_with_farther_centre():
    low, high = np.array([[-9, -9, -1], [7, 7, 0.0]]), np.array([[9, 9, 0], [8, 8, 1.0]])
    order = find_painting_order(low, high, np.array([-5, -5, 3.0]), np.array([False, False]))
    assert order == [0, 1]


def test_tip_is_drawn_at_the_kinematic_position(robot_scene):
    robot_scene.choose_ghosts(RobotGhost.REAL)
    robot_scene.set_viewpoint(SceneViewpoint.FRONT)
    picture = make_picture(robot_scene)
    solids = {solid.path: solid for solid in picture.project_solids(WIDTH, HEIGHT)}
    assert not any(path.startswith("/robot/model") for path in solids)
    tip = compute_tip_position(robot_scene.chain, robot_scene.chain.centre)
    expected = project_to_pixels(picture.camera.to_camera_frame(np.array([tip])), WIDTH, HEIGHT)[0]
    corners = solids["/robot/real/x/y/z/tilt/pin/pin"].lines.reshape(-1, 2)
    lowest = corners[corners[:, 1] > corners[:, 1].max() - 0.5]
    assert lowest.mean(axis=0) == pytest.approx(expected, abs=0.5)


def test_moved_axis_moves_only_the_pixels_of_its_bodies(robot_scene):
    robot_scene.set_viewpoint(SceneViewpoint.FRONT)

    def project_lines():
        return {
            solid.path: solid.lines
            for solid in make_picture(robot_scene).project_solids(WIDTH, HEIGHT)
        }

    before = project_lines()
    middle = robot_scene.chain.centre[0]
    set_positions(robot_scene, x=middle + 2e-3)
    after = project_lines()
    for path in ("/robot/real/x/carriage", "/robot/real/x/y/z/housing"):
        shift_px = np.mean(after[path][:, 0]) - np.mean(before[path][:, 0])
        assert 1 < shift_px < 10
    for path in ("/robot/base/base", "/robot/model/x/carriage", "/robot/specimen/cell"):
        assert after[path] == pytest.approx(before[path])


def test_every_view_stays_within_the_picture_and_shows_both_robots(robot_scene):
    for view in SceneViewpoint:
        robot_scene.set_viewpoint(view)
        solids = make_picture(robot_scene).project_solids(WIDTH, HEIGHT)
        assert {solid.path.split("/")[2] for solid in solids} >= {"model", "real"}
        corners = np.vstack([np.array(face) for solid in solids for face in solid.faces])
        lines = np.vstack([solid.lines.reshape(-1, 2) for solid in solids])
        for points in (corners, lines):
            centred = np.abs(points - [WIDTH / 2, HEIGHT / 2]) / [WIDTH, HEIGHT]
            assert np.all(centred <= 0.55 + 1e-9), view


def test_nothing_is_drawn_without_a_view_or_of_a_hidden_robot(robot_scene):
    assert ProjectedPicture().project_solids(WIDTH, HEIGHT) == []
    robot_scene.show_positions(GhostPositions({}, {}))
    solids = make_picture(robot_scene).project_solids(WIDTH, HEIGHT)
    assert {solid.path.split("/")[2] for solid in solids} <= {"base", "specimen", "bounds"}
