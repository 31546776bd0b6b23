"""Images of the scene: objects appear where the optics project them, with the chip's noise."""

from dataclasses import replace
from math import pi, sqrt

import numpy as np
import pytest

from rotemina.sim.errors import SceneError
from rotemina.sim.kinematics import KinematicChain, compute_tip_position, compute_tool_axis
from rotemina.sim.microscope import (
    UNTOUCHED_CELL_STATE,
    MicroscopeScene,
    SceneRenderer,
    TaperedPin,
    advance_cell_state,
    kernels,
)
from rotemina.sim.microscope.cell import CellState
from rotemina.sim.microscope.optics import MicroscopeOptics
from rotemina.sim.microscope.pin_image import body_direction
from rotemina.sim.microscope.scene import SceneLighting
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
CHAIN = KinematicChain.of(ROBOT)
TIP, AXIS = compute_tip_position(CHAIN, CHAIN.centre), compute_tool_axis(CHAIN.centre)
EVEN = SceneLighting(vignetting=0.0, gradient=(0.0, 0.0), dust=0.0)
SIDE_OFFSET = np.array([30e-6, 0.0, 0.0])
SMALL = {"width": 260, "height": 200}


def make_scene(**changes):
    optics_options = {
        name: changes.pop(name)
        for name in tuple(changes)
        if name in MicroscopeOptics.__annotations__
    }
    default_scene = MicroscopeScene.of(ROBOT, **{**SMALL, **optics_options})
    return replace(default_scene, **{"light": EVEN, "cell": None, **changes})


def measure_dark_offset(light, tip):
    """Return the offset (u, v) of the centroid of dark pixels from the tip, px."""
    darkness = np.maximum(1.0 - light - 0.02, 0.0)
    rows, columns = np.indices(light.shape)
    return np.array([(darkness * columns).sum(), (darkness * rows).sum()]) / darkness.sum() - tip


@pytest.mark.parametrize("shift_m", [(0.0, 0.0, 0.0), (3.21e-6, -1.77e-6, 0.0)])
def test_an_upright_pin_appears_where_the_optics_project_it(shift_m):
    scene = make_scene(pin=TaperedPin(approach_rad=pi / 2), rotation_rad=0.3, mirrored=True)
    tip = TIP + np.array(shift_m)
    light = SceneRenderer(scene).render_light(tip, np.array([0.0, 0.0, 1.0]), 0.0)
    assert np.abs(measure_dark_offset(light, scene.optics.pixel_of(tip))).max() < 0.02


@pytest.mark.parametrize("mounting", [{}, {"rotation_rad": 0.5}, {"axis": (0.0, 0.8, 0.6)}])
def test_the_pin_ends_at_the_tip_and_lies_along_its_body(mounting):
    scene = make_scene(**mounting)
    light = SceneRenderer(scene).render_light(TIP, AXIS, 0.0)
    tip = scene.optics.pixel_of(TIP)
    direction = scene.optics.mapping @ body_direction(scene.pin, AXIS)
    direction /= np.linalg.norm(direction)
    across = np.array([-direction[1], direction[0]])

    def get_darkness(along, sideways=0.0):
        u, v = np.rint(tip + along * direction + sideways * across).astype(int)
        return 1.0 - light[v, u]

    assert get_darkness(-5.0) < 0.01
    assert get_darkness(4.0) > 0.15
    assert get_darkness(0.0) == pytest.approx(0.5 * get_darkness(2.0), abs=0.1)
    assert get_darkness(10.0, 8.0) < get_darkness(10.0) > get_darkness(10.0, -8.0)
    assert get_darkness(10.0, 30.0) < 0.01


def test_a_subpixel_move_of_the_tip_moves_the_image_equally():
    scene = make_scene()
    renderer = SceneRenderer(scene)
    before = renderer.render_light(TIP, AXIS, 0.0)
    after = renderer.render_light(TIP + np.array([0.0, 0.1 * scene.optics.pixel_m, 0.0]), AXIS, 0.0)
    # To first order the change is −0.1 px times the slope down the rows.
    slope = np.gradient(before, axis=0)
    shift_px = -((after - before) * slope).sum() / (slope**2).sum()
    assert shift_px == pytest.approx(0.1, abs=0.01)


def test_the_image_is_sharpest_with_the_focus_at_the_tip():
    renderer = SceneRenderer(make_scene())
    tip = TIP + np.array([0.0, 0.0, 10e-6])
    sharpness = {
        focus: (
            np.gradient(renderer.render_light(tip, AXIS, focus)[80:120, 127:132], axis=0) ** 2
        ).sum()
        for focus in (-10e-6, 0.0, 8e-6, 10e-6, 12e-6, 20e-6)
    }
    assert max(sharpness, key=sharpness.get) == 10e-6
    assert sharpness[-10e-6] < sharpness[0.0] < sharpness[8e-6]
    assert sharpness[20e-6] < sharpness[12e-6]


def test_tip_and_shank_of_the_pin_are_sharp_in_different_planes():
    scene = make_scene()
    renderer = SceneRenderer(scene)

    def measure_edge(light, along_px):
        """Return the steepest edge of the pin at this distance from its tip."""
        u = round(scene.optics.pixel_of(TIP)[0] + along_px)
        return np.abs(np.diff(light[:, u])).max()

    rise = np.tan(scene.pin.approach_rad) * 60 * scene.optics.pixel_m
    low, high = renderer.render_light(TIP, AXIS, 0.0), renderer.render_light(TIP, AXIS, rise)
    assert measure_edge(low, 5) > measure_edge(low, 60)
    assert measure_edge(high, 60) > measure_edge(low, 60)
    assert measure_edge(high, 5) < measure_edge(low, 5)


def test_the_body_turns_with_the_tool_axis():
    pin = TaperedPin(approach_rad=pi / 2)
    np.testing.assert_allclose(body_direction(pin, AXIS), AXIS, atol=1e-15)
    tilted = body_direction(TaperedPin(approach_rad=0.5), np.array([np.sin(0.1), 0.0, np.cos(0.1)]))
    np.testing.assert_allclose(tilted, [np.cos(0.4), 0.0, np.sin(0.4)], atol=1e-12)


def test_noise_matches_the_chip_model():
    scene = make_scene(light=replace(EVEN, rate=5e5))
    renderer, rng = SceneRenderer(scene), np.random.default_rng(3)
    empty = np.ones((200, 260), np.float32)
    for exposure_s, gain in ((0.02, 1.0), (0.005, 1.0), (0.005, 2.0)):
        numbers = renderer.expose(empty, rng, exposure_s, gain)
        electrons = 5e5 * exposure_s
        assert numbers.mean() == pytest.approx(40.0 + gain * electrons / 4.0, rel=2e-3)
        expected = gain * sqrt(electrons + 64.0) / 4.0
        assert numbers.std() == pytest.approx(sqrt(expected**2 + 1 / 12), rel=0.02)


def test_noise_is_uncorrelated_in_space_and_time():
    renderer, rng = SceneRenderer(make_scene()), np.random.default_rng(3)
    empty = np.ones((200, 260), np.float32)
    first, second = (renderer.expose(empty, rng, 0.02, 1.0).astype(float) for _ in range(2))
    for image, other_image in (
        (first, second),
        (first[:, 1:], first[:, :-1]),
        (first[1:], first[:-1]),
    ):
        assert abs(np.corrcoef(image.ravel(), other_image.ravel())[0, 1]) < 0.02


def test_overexposure_saturates():
    numbers = SceneRenderer(make_scene()).render_frame(
        TIP, AXIS, 0.0, np.random.default_rng(1), exposure_s=1.0
    )
    assert numbers.max() == 4095
    assert np.median(numbers) == 4095


def test_illumination_decreases_towards_the_edges():
    light = replace(EVEN, vignetting=0.2, gradient=(0.1, 0.0))
    field = SceneRenderer(make_scene(light=light)).render_light(TIP + 1e-2, AXIS, 0.0)
    np.testing.assert_allclose(field[[0, 0], [0, -1]], [0.75, 0.85], atol=1e-6)
    assert field.max() <= 1.05


def test_the_same_seed_gives_the_same_image():
    scene = MicroscopeScene.of(ROBOT, seed=4, **SMALL)
    first, second = (
        SceneRenderer(scene).render_frame(TIP, AXIS, 0.0, np.random.default_rng(7))
        for _ in range(2)
    )
    np.testing.assert_array_equal(first, second)
    assert first.dtype == np.uint16
    second = SceneRenderer(scene).render_frame(TIP, AXIS, 0.0, np.random.default_rng(8))
    assert (first != second).mean() > 0.9


def make_cell_scene(**mounting):
    return replace(MicroscopeScene.of(ROBOT, **mounting), light=EVEN)


def test_a_reused_renderer_draws_the_same_as_a_new_one():
    scene = make_cell_scene(width=700, height=500)
    reused_renderer = SceneRenderer(scene)
    contact = np.array(scene.cell.centre_m) + np.array([20e-6, 0.0, 0.0])
    state = advance_cell_state(scene.cell, CellState(tip_m=tuple(contact + SIDE_OFFSET)), contact)
    for tip, focus, cell_state in (
        (TIP, 0.0, UNTOUCHED_CELL_STATE),
        (contact, 0.0, state),
        (TIP, 5e-6, UNTOUCHED_CELL_STATE),
    ):
        np.testing.assert_array_equal(
            reused_renderer.render_light(tip, AXIS, focus, cell_state),
            SceneRenderer(scene).render_light(tip, AXIS, focus, cell_state),
        )


def test_the_cell_appears_at_its_position_and_size():
    scene = make_cell_scene(rotation_rad=0.4)
    light = SceneRenderer(scene).render_light(TIP + 1e-2, AXIS, scene.cell.centre_m[2] - TIP[2])
    angles = 2.0 * pi * np.arange(24) / 24.0
    ring = np.stack([np.cos(angles), np.sin(angles), np.zeros(24)], axis=-1)
    for share, is_dark in ((1.0, True), (1.3, False)):
        points = np.array(scene.cell.centre_m) + share * np.array(scene.cell.radii_m) * ring
        u, v = np.rint(scene.optics.pixel_of(points)).astype(int).T
        assert (light[v, u] < 0.93).all() == is_dark
        assert (light[v, u] > 0.99).all() != is_dark


def test_contact_dents_the_membrane_and_piercing_makes_a_hole():
    scene = make_cell_scene()
    renderer, cell, tip_out_of_view = (
        SceneRenderer(scene),
        scene.cell,
        TIP + 1e-2,
    )  # the pin is out of view
    focus = cell.centre_m[2] - TIP[2]
    edge = np.array(cell.centre_m) + np.array([cell.radii_m[0], 0.0, 0.0])
    start = CellState(tip_m=tuple(edge + SIDE_OFFSET))
    pressed = advance_cell_state(cell, start, edge - [3.5e-6, 0.0, 0.0])
    pierced_state = advance_cell_state(cell, pressed, edge - [6e-6, 0.0, 0.0])
    retreat = advance_cell_state(cell, pierced_state, edge + SIDE_OFFSET)
    assert (pressed.is_pierced, pierced_state.is_pierced, retreat.is_pierced) == (False, True, True)
    u, v = np.rint(scene.optics.pixel_of(edge)).astype(int)
    lights = [
        renderer.render_light(tip_out_of_view, AXIS, focus, state)
        for state in (start, pressed, retreat)
    ]
    intact, dented, pierced = (light[v, u - 30 : u + 6] for light in lights)
    assert intact[30] < 0.85
    assert dented[30] > intact[30] + 0.1  # the membrane has moved
    assert pierced[30] > intact[30] + 0.1  # the membrane has a hole
    top = np.array(cell.centre_m) + np.array([0.0, 0.0, cell.radii_m[2]])
    down = np.array([0.0, 0.0, 3e-6])
    above = advance_cell_state(cell, CellState(tip_m=tuple(top + down)), top - down)
    middle = np.rint(scene.optics.pixel_of(np.array(cell.centre_m))).astype(int)
    brightness = renderer.render_light(tip_out_of_view, AXIS, focus, above)[middle[1], middle[0]]
    assert brightness < lights[0][middle[1], middle[0]] - 0.02  # a dent towards the objective
    behind = np.rint(scene.optics.pixel_of(2 * np.array(cell.centre_m) - edge)).astype(int)
    np.testing.assert_allclose(lights[2][behind[1], behind[0]], lights[0][behind[1], behind[0]])


def test_a_scene_far_out_of_view_is_empty():
    light = SceneRenderer(make_scene()).render_light(TIP + np.array([0.0, 5e-3, 0.0]), AXIS, 0.0)
    np.testing.assert_array_equal(light, 1.0)


@pytest.mark.parametrize("angle", [0.0, -0.1, 1.6, float("nan")])
def test_invalid_approach_angles_are_refused(angle):
    with pytest.raises(SceneError, match="approach_angle"):
        TaperedPin(approach_rad=angle)


def test_the_image_does_not_depend_on_the_position_of_blocks():
    rng = np.random.default_rng(0)
    for _ in range(15):
        angle, shape = rng.uniform(0.0, 2.0 * np.pi), tuple(rng.integers(50, 300, 2))
        tip = rng.uniform(-200.0, 500.0, 2)
        shape_arguments = (
            (np.cos(angle), np.sin(angle)),
            (rng.uniform(0.5, 5.0), rng.uniform(0.0, 0.3), rng.uniform(20.0, 200.0)),
            (rng.uniform(-20.0, 20.0), rng.uniform(-0.5, 0.5)),
            (rng.uniform(0.2, 2.0), 0.0833),
            (0.55, 0.3, 0.6),
        )
        images = []
        for shift in (0, 13):  # blocks begin at other columns
            light = np.ones((shape[0], shape[1] + shift), np.float32)
            arguments = (tip + np.array([shift, 0.0]), *shape_arguments)
            kernels.draw_tube(
                light, *(np.array(argument, dtype=np.float32) for argument in arguments)
            )
            images.append(light[:, shift:])
        np.testing.assert_allclose(images[0], images[1], rtol=0, atol=4e-5)
