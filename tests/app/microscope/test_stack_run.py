"""A z-stack: where its pictures are taken, what ends it, and the file that is made of it."""

import json
from itertools import count

import numpy as np
import pytest
import tifffile

from rotemina.app.cameras.snapshot import Circumstances, write_stack
from rotemina.app.microscope import stack_run
from rotemina.app.microscope.errors import MicroscopeError
from rotemina.app.microscope.focus_run import Search
from rotemina.app.microscope.stack_run import StackRun, places_of
from rotemina.sim.microscope.renderer import Renderer

UM = 1e-6


def started(bench, places, move=None):
    return StackRun(
        bench.session,
        bench.newest,
        move or (lambda place, _: bench.camera.move_focus(place)),
        "focus",
        places,
        0.0,
        now_s=bench.clock(),
    )


def run_until_over(bench, run):
    for _ in range(400):
        bench.step()
        if run.step(bench.clock()).search is not Search.UNDER_WAY:
            return run.status
    raise AssertionError(run.status)


def test_places_are_even_and_never_beyond_the_last():
    assert places_of(-2 * UM, 2 * UM, UM) == pytest.approx([-2 * UM, -UM, 0.0, UM, 2 * UM])
    assert places_of(0.0, -2.5 * UM, UM) == pytest.approx([0.0, -UM, -2 * UM])
    assert places_of(UM, UM, UM) == (UM,)
    for step in (0.0, -UM, float("nan")):
        with pytest.raises(MicroscopeError, match="must be above 0 µm"):
            places_of(0.0, UM, step)
    with pytest.raises(
        MicroscopeError, match="1001 pictures: must be at most 1000; use a larger step"
    ):
        places_of(0.0, 1e-3, UM)


def test_a_picture_is_of_its_place_though_reads_fail_among_them(bench, monkeypatch):
    draw, read = Renderer.frame, count(1)

    def draw_some(*args, **options):
        if next(read) % 5:
            raise MemoryError
        return draw(*args, **options)

    monkeypatch.setattr(Renderer, "frame", draw_some)
    places = places_of(-20 * UM, 20 * UM, 20 * UM)
    status = run_until_over(bench, started(bench, places))
    assert status.search is Search.DONE, status.reason
    assert [page.frame.metadata["focus_m"] for page in status.pages] == list(places)


def test_a_picture_at_each_place_then_back_and_into_a_file_of_pages(bench, tmp_path):
    places = places_of(-20 * UM, 20 * UM, 20 * UM)
    status = run_until_over(bench, started(bench, places))
    assert status.search is Search.DONE, status.reason
    assert bench.camera.focus_m == 0.0
    assert [page.place for page in status.pages] == list(places)
    images = [page.frame.pixels for page in status.pages]
    assert not np.array_equal(images[0], images[1])
    path = tmp_path / "stack.tif"
    write_stack(path, status.pages, "focus", Circumstances(pixel_m=0.33e-6))
    with tifffile.TiffFile(path) as file:
        assert len(file.pages) == 3
        for page, image, place in zip(file.pages, images, places, strict=True):
            assert np.array_equal(page.asarray(), image)
            facts = json.loads(page.description)
            assert (facts["focus_axis"], facts["focus_m"]) == ("focus", place)
            assert facts["pages"] == 3
            assert set(facts["measured"]) == set(bench.robot.axes)


def test_a_stop_ends_it_where_it_is(bench):
    run = started(bench, places_of(-20 * UM, 20 * UM, 10 * UM))
    while run.status.done < 2:
        bench.step()
        run.step(bench.clock())
    bench.session.stop()
    status = run_until_over(bench, run)
    assert status.search is Search.FAILED
    assert status.pages == ()
    assert bench.camera.focus_m < 10 * UM


def test_what_does_not_fit_is_refused_before_anything_moves(bench, monkeypatch):
    moved = []
    monkeypatch.setattr(stack_run, "MOST_BYTES", 1_000_000)
    with pytest.raises(
        MicroscopeError, match=r"5 pictures of 0\.7 MB: must be at most 1 MB together"
    ):
        started(bench, places_of(0.0, 4 * UM, UM), lambda *asked: moved.append(asked))
    assert moved == []
