"""Pictures of the scene: the truth must be where the optics say, and noise what the chip says."""

from dataclasses import replace
from math import pi, sqrt

import numpy as np
import pytest

from rotemina.sim.kinematics.chain import Chain
from rotemina.sim.kinematics.forward import tip_position, tool_axis
from rotemina.sim.microscope import kernels
from rotemina.sim.microscope.cell import UNTOUCHED, CellState, met
from rotemina.sim.microscope.errors import SceneError
from rotemina.sim.microscope.optics import Optics
from rotemina.sim.microscope.pin_image import body_direction
from rotemina.sim.microscope.renderer import Renderer
from rotemina.sim.microscope.scene import Light, Pin, Scene
from rotemina.sim.robot.file import load_robot

ROBOT = load_robot("rotemina")
CHAIN = Chain.of(ROBOT)
TIP, AXIS = tip_position(CHAIN, CHAIN.centre), tool_axis(CHAIN.centre)
EVEN = Light(vignetting=0.0, gradient=(0.0, 0.0), dust=0.0)
BESIDE = np.array([30e-6, 0.0, 0.0])
SMALL = {"width": 260, "height": 200}


def scene(**changes):
    mounting = {
        name: changes.pop(name) for name in tuple(changes) if name in Optics.__annotations__
    }
    base = Scene.of(ROBOT, **{**SMALL, **mounting})
    return replace(base, **{"light": EVEN, "cell": None, **changes})


def darkest(light, tip):
    """Return the centroid (u, v) of what is dark around a place, and how dark it is in all."""
    dark = np.maximum(1.0 - light - 0.02, 0.0)
    rows, columns = np.indices(light.shape)
    return np.array([(dark * columns).sum(), (dark * rows).sum()]) / dark.sum() - tip


@pytest.mark.parametrize("shift_m", [(0.0, 0.0, 0.0), (3.21e-6, -1.77e-6, 0.0), (-7.5e-6, 4e-6, 0)])
def test_an_upright_pin_is_seen_where_the_optics_say(shift_m):
    upright = scene(pin=Pin(approach_rad=pi / 2), rotation_rad=0.3, mirrored=True)
    tip = TIP + np.array(shift_m)
    light = Renderer(upright).light(tip, np.array([0.0, 0.0, 1.0]), 0.0)
    assert np.abs(darkest(light, upright.optics.pixel_of(tip))).max() < 0.02


@pytest.mark.parametrize("mounting", [{}, {"rotation_rad": 0.5}, {"axis": (0.0, 0.8, 0.6)}])
def test_the_pin_ends_at_the_tip_and_lies_along_its_body(mounting):
    seen = scene(**mounting)
    light = Renderer(seen).light(TIP, AXIS, 0.0)
    tip = seen.optics.pixel_of(TIP)
    way = seen.optics.mapping @ body_direction(seen.pin, AXIS)
    way /= np.linalg.norm(way)
    across = np.array([-way[1], way[0]])

    def at(along, aside=0.0):
        u, v = np.rint(tip + along * way + aside * across).astype(int)
        return 1.0 - light[v, u]

    assert at(-5.0) < 0.01
    assert at(4.0) > 0.15
    assert at(0.0) == pytest.approx(0.5 * at(2.0), abs=0.1)
    assert at(10.0, 8.0) < at(10.0) > at(10.0, -8.0)
    assert at(10.0, 30.0) < 0.01


def test_a_subpixel_move_of_the_tip_moves_the_picture_by_as_much():
    seen = scene()
    drawn = Renderer(seen)
    before = drawn.light(TIP, AXIS, 0.0)
    after = drawn.light(TIP + np.array([0.0, 0.1 * seen.optics.pixel_m, 0.0]), AXIS, 0.0)
    # To first order the change is −0.1 px times the slope down the rows.
    slope = np.gradient(before, axis=0)
    moved = -((after - before) * slope).sum() / (slope**2).sum()
    assert moved == pytest.approx(0.1, abs=0.01)


def test_focus_sharpens_the_tip_where_it_is():
    drawn = Renderer(scene())
    tip = TIP + np.array([0.0, 0.0, 10e-6])
    sharpness = {
        focus: (np.gradient(drawn.light(tip, AXIS, focus)[80:120, 127:132], axis=0) ** 2).sum()
        for focus in (-10e-6, 0.0, 8e-6, 10e-6, 12e-6, 20e-6)
    }
    assert max(sharpness, key=sharpness.get) == 10e-6
    assert sharpness[-10e-6] < sharpness[0.0] < sharpness[8e-6]
    assert sharpness[20e-6] < sharpness[12e-6]


def test_the_pin_rises_out_of_focus_and_its_shank_is_sharp_at_another_plane():
    seen = scene()
    drawn = Renderer(seen)

    def slope(light, along_px):  # of the pin's edges, at a place of its body
        u = round(seen.optics.pixel_of(TIP)[0] + along_px)
        return np.abs(np.diff(light[:, u])).max()

    rise = np.tan(seen.pin.approach_rad) * 60 * seen.optics.pixel_m
    low, high = drawn.light(TIP, AXIS, 0.0), drawn.light(TIP, AXIS, rise)
    assert slope(low, 5) > slope(low, 60)
    assert slope(high, 60) > slope(low, 60)
    assert slope(high, 5) < slope(low, 5)


def test_the_body_turns_with_the_tool_axis():
    pin = Pin(approach_rad=pi / 2)
    np.testing.assert_allclose(body_direction(pin, AXIS), AXIS, atol=1e-15)
    tilted = body_direction(Pin(approach_rad=0.5), np.array([np.sin(0.1), 0.0, np.cos(0.1)]))
    np.testing.assert_allclose(tilted, [np.cos(0.4), 0.0, np.sin(0.4)], atol=1e-12)


def test_noise_is_what_the_chip_says():
    seen = scene(light=replace(EVEN, rate=5e5))
    drawn, rng = Renderer(seen), np.random.default_rng(3)
    empty = np.ones((200, 260), np.float32)
    for exposure_s, gain in ((0.02, 1.0), (0.005, 1.0), (0.005, 2.0)):
        numbers = drawn.exposed(empty, rng, exposure_s, gain)
        electrons = 5e5 * exposure_s
        assert numbers.mean() == pytest.approx(40.0 + gain * electrons / 4.0, rel=2e-3)
        expected = gain * sqrt(electrons + 64.0) / 4.0
        assert numbers.std() == pytest.approx(sqrt(expected**2 + 1 / 12), rel=0.02)


def test_noise_has_no_pattern_and_does_not_come_again():
    drawn, rng = Renderer(scene()), np.random.default_rng(3)
    empty = np.ones((200, 260), np.float32)
    first, second = (drawn.exposed(empty, rng, 0.02, 1.0).astype(float) for _ in range(2))
    for one, other in (
        (first, second),
        (first[:, 1:], first[:, :-1]),
        (first[1:], first[:-1]),
    ):
        assert abs(np.corrcoef(one.ravel(), other.ravel())[0, 1]) < 0.02


def test_too_much_light_saturates():
    numbers = Renderer(scene()).frame(TIP, AXIS, 0.0, np.random.default_rng(1), exposure_s=1.0)
    assert numbers.max() == 4095
    assert np.median(numbers) == 4095


def test_illumination_falls_off_to_the_edges():
    light = replace(EVEN, vignetting=0.2, gradient=(0.1, 0.0))
    field = Renderer(scene(light=light)).light(TIP + 1e-2, AXIS, 0.0)
    np.testing.assert_allclose(field[[0, 0], [0, -1]], [0.75, 0.85], atol=1e-6)
    assert field.max() <= 1.05


def test_the_same_seed_gives_the_same_picture():
    seen = Scene.of(ROBOT, seed=4, **SMALL)
    one, other = (Renderer(seen).frame(TIP, AXIS, 0.0, np.random.default_rng(7)) for _ in range(2))
    np.testing.assert_array_equal(one, other)
    assert one.dtype == np.uint16
    other = Renderer(seen).frame(TIP, AXIS, 0.0, np.random.default_rng(8))
    assert (one != other).mean() > 0.9


def with_cell(**mounting):
    return replace(Scene.of(ROBOT, **mounting), light=EVEN)


def test_what_is_drawn_anew_is_the_same_as_drawn_from_nothing():
    seen = with_cell(width=700, height=500)
    kept = Renderer(seen)
    contact = np.array(seen.cell.centre_m) + np.array([20e-6, 0.0, 0.0])
    state = met(seen.cell, CellState(tip_m=tuple(contact + BESIDE)), contact)
    for tip, focus, now in ((TIP, 0.0, UNTOUCHED), (contact, 0.0, state), (TIP, 5e-6, UNTOUCHED)):
        np.testing.assert_array_equal(
            kept.light(tip, AXIS, focus, now), Renderer(seen).light(tip, AXIS, focus, now)
        )


def test_the_cell_is_where_it_is_and_has_its_size():
    seen = with_cell(rotation_rad=0.4)
    light = Renderer(seen).light(TIP + 1e-2, AXIS, seen.cell.centre_m[2] - TIP[2])
    around = 2.0 * pi * np.arange(24) / 24.0
    ring = np.stack([np.cos(around), np.sin(around), np.zeros(24)], axis=-1)
    for share, dark in ((1.0, True), (1.3, False)):
        points = np.array(seen.cell.centre_m) + share * np.array(seen.cell.radii_m) * ring
        u, v = np.rint(seen.optics.pixel_of(points)).astype(int).T
        assert (light[v, u] < 0.93).all() == dark
        assert (light[v, u] > 0.99).all() != dark


def test_contact_dents_the_membrane_and_piercing_leaves_a_hole():
    seen = with_cell()
    drawn, cell, away = Renderer(seen), seen.cell, TIP + 1e-2  # no pin in the picture
    focus = cell.centre_m[2] - TIP[2]
    edge = np.array(cell.centre_m) + np.array([cell.radii_m[0], 0.0, 0.0])
    start = CellState(tip_m=tuple(edge + BESIDE))
    pushed = met(cell, start, edge - [3.5e-6, 0.0, 0.0])
    inside = met(cell, pushed, edge - [6e-6, 0.0, 0.0])
    retreat = met(cell, inside, edge + BESIDE)
    assert (pushed.pierced, inside.pierced, retreat.pierced) == (False, True, True)
    u, v = np.rint(seen.optics.pixel_of(edge)).astype(int)
    lights = [drawn.light(away, AXIS, focus, state) for state in (start, pushed, retreat)]
    rest, dented, pierced = (light[v, u - 30 : u + 6] for light in lights)
    assert rest[30] < 0.85
    assert dented[30] > rest[30] + 0.1  # the membrane has left its place
    assert pierced[30] > rest[30] + 0.1  # there is a gap
    top = np.array(cell.centre_m) + np.array([0.0, 0.0, cell.radii_m[2]])
    down = np.array([0.0, 0.0, 3e-6])
    above = met(cell, CellState(tip_m=tuple(top + down)), top - down)
    middle = np.rint(seen.optics.pixel_of(np.array(cell.centre_m))).astype(int)
    shaded = drawn.light(away, AXIS, focus, above)[middle[1], middle[0]]
    assert shaded < lights[0][middle[1], middle[0]] - 0.02  # a dent towards the objective
    behind = np.rint(seen.optics.pixel_of(2 * np.array(cell.centre_m) - edge)).astype(int)
    np.testing.assert_allclose(lights[2][behind[1], behind[0]], lights[0][behind[1], behind[0]])


def test_a_scene_far_out_of_view_is_empty():
    light = Renderer(scene()).light(TIP + np.array([0.0, 5e-3, 0.0]), AXIS, 0.0)
    np.testing.assert_array_equal(light, 1.0)


@pytest.mark.parametrize("angle", [0.0, -0.1, 1.6, float("nan")])
def test_what_is_no_approach_angle(angle):
    with pytest.raises(SceneError, match="approach_angle"):
        Pin(approach_rad=angle)


def test_which_blocks_of_a_row_are_left_out_is_not_seen():
    rng = np.random.default_rng(0)
    for _ in range(40):
        angle, shape = rng.uniform(0.0, 2.0 * np.pi), tuple(rng.integers(50, 300, 2))
        tip = rng.uniform(-200.0, 500.0, 2)
        rest = (
            (np.cos(angle), np.sin(angle)),
            (rng.uniform(0.5, 5.0), rng.uniform(0.0, 0.3), rng.uniform(20.0, 200.0)),
            (rng.uniform(-20.0, 20.0), rng.uniform(-0.5, 0.5)),
            (rng.uniform(0.2, 2.0), 0.0833),
            (0.55, 0.3, 0.6),
        )
        drawn = []
        for shift in (0, 13):  # blocks begin elsewhere
            light = np.ones((shape[0], shape[1] + shift), np.float32)
            places = (tip + np.array([shift, 0.0]), *rest)
            kernels.draw_tube(light, *(np.array(one, dtype=np.float32) for one in places))
            drawn.append(light[:, shift:])
        np.testing.assert_allclose(drawn[0], drawn[1], rtol=0, atol=4e-5)
