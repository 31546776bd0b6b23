"""A z-stack: the positions of its pictures, its failures and its file."""

import json
from itertools import count

import numpy as np
import pytest
import tifffile

from rotemina.app.cameras import SnapshotMetadata, write_stack
from rotemina.app.errors import MicroscopeError
from rotemina.app.microscope import MicroscopeRunState, stack_run
from rotemina.app.microscope.stack_run import StackRun, compute_stack_positions
from rotemina.sim.microscope import SceneRenderer

UM = 1e-6


def start_stack(bench, positions, move=None):
    return StackRun(
        bench.session,
        bench.get_newest_frame,
        move or (lambda place, _: bench.camera.move_focus(place)),
        "focus",
        positions,
        0.0,
        now_s=bench.clock(),
    )


def test_positions_are_evenly_spaced_up_to_the_last():
    assert compute_stack_positions(-2 * UM, 2 * UM, UM) == pytest.approx(
        [-2 * UM, -UM, 0.0, UM, 2 * UM]
    )
    assert compute_stack_positions(0.0, -2.5 * UM, UM) == pytest.approx([0.0, -UM, -2 * UM])
    assert compute_stack_positions(UM, UM, UM) == (UM,)
    for step in (0.0, -UM, float("nan")):
        with pytest.raises(MicroscopeError, match="must be above 0 µm"):
            compute_stack_positions(0.0, UM, step)
    with pytest.raises(
        MicroscopeError, match="1001 pictures: must be at most 1000; use a larger step"
    ):
        compute_stack_positions(0.0, 1e-3, UM)


def test_pictures_match_their_positions_despite_failed_reads(bench, monkeypatch):
    render, read_numbers = SceneRenderer.render_frame, count(1)

    def render_or_fail(*args, **options):
        if next(read_numbers) % 5:
            raise MemoryError
        return render(*args, **options)

    monkeypatch.setattr(SceneRenderer, "render_frame", render_or_fail)
    positions = compute_stack_positions(-20 * UM, 20 * UM, 20 * UM)
    status = bench.run_until_finished(start_stack(bench, positions))
    assert status.state is MicroscopeRunState.DONE, status.reason
    assert [page.frame.metadata["focus_m"] for page in status.pages] == list(positions)


def test_stack_takes_a_picture_per_position_returns_and_is_written(bench, tmp_path):
    positions = compute_stack_positions(-20 * UM, 20 * UM, 20 * UM)
    status = bench.run_until_finished(start_stack(bench, positions))
    assert status.state is MicroscopeRunState.DONE, status.reason
    assert bench.camera.focus_m == 0.0
    assert [page.focus_m for page in status.pages] == list(positions)
    images = [page.frame.pixels for page in status.pages]
    assert not np.array_equal(images[0], images[1])
    path = tmp_path / "stack.tif"
    write_stack(path, status.pages, "focus", SnapshotMetadata(pixel_m=0.33e-6))
    with tifffile.TiffFile(path) as file:
        assert len(file.pages) == 3
        for page, image, position in zip(file.pages, images, positions, strict=True):
            assert np.array_equal(page.asarray(), image)
            description = json.loads(page.description)
            assert (description["focus_axis"], description["focus_m"]) == ("focus", position)
            assert description["pages"] == 3
            assert set(description["measured"]) == set(bench.robot.axes)


def test_stop_ends_the_stack_in_place(bench):
    run = start_stack(bench, compute_stack_positions(-20 * UM, 20 * UM, 10 * UM))
    bench.run_until(run, lambda status: status.done >= 2)
    bench.session.stop()
    status = bench.run_until_finished(run)
    assert status.state is MicroscopeRunState.FAILED
    assert status.pages == ()
    assert bench.camera.focus_m < 10 * UM


@pytest.mark.parametrize("is_refused", [True, False])
def test_failed_return_keeps_the_pictures(bench, is_refused):
    """The return is refused at once, or a stop interrupts it."""
    moves = []

    def move(place, _permit):
        moves.append(place)
        if is_refused and len(moves) == 3:
            raise MicroscopeError("the drive is reserved")
        bench.camera.move_focus(place)

    run = start_stack(bench, (-20 * UM, 20 * UM), move)
    bench.run_until(run, lambda _: len(moves) == 3)
    if not is_refused:
        bench.session.stop()
    status = bench.run_until_finished(run)
    assert status.state is MicroscopeRunState.DONE
    assert [page.focus_m for page in status.pages] == [-20 * UM, 20 * UM]
    assert status.reason.startswith("the return to the start position failed: ")


def test_stack_that_is_too_large_is_refused_before_any_move(bench, monkeypatch):
    moves = []
    monkeypatch.setattr(stack_run, "MAX_STACK_BYTES", 1_000_000)
    with pytest.raises(
        MicroscopeError, match=r"5 pictures of 0\.7 MB: must be at most 1 MB together"
    ):
        start_stack(
            bench,
            compute_stack_positions(0.0, 4 * UM, UM),
            lambda *arguments: moves.append(arguments),
        )
    assert moves == []
