"""The file of inverses: the same commands after reading, and what is wrong with a bad one."""

import json

import numpy as np
import pytest

from rotemina.sim.compensate.errors import CompensationError
from rotemina.sim.compensate.file import Provenance, Source, read_trained, write_trained
from rotemina.sim.compensate.inverse import Inverse
from rotemina.sim.errors import InputError

SOURCE = Source(name="a.csv", sha256="0" * 64, rows=100)
PROVENANCE = Provenance(
    robot="RoTeMiNa", trained_on=[SOURCE], held_out=[], seed=None, versions={"numpy": "2"}
)


@pytest.fixture
def path(tmp_path, trained):
    write_trained(tmp_path / "zn.json", trained, PROVENANCE)
    return tmp_path / "zn.json"


def test_what_is_read_commands_the_same(path, trained):
    read, provenance = read_trained(path)
    assert provenance == PROVENANCE
    assert read.residuals == trained.residuals
    assert (read.chosen, read.why, read.remarks) == (trained.chosen, trained.why, trained.remarks)
    wanted = 30e-6 + 20e-6 * np.sin(np.linspace(0.0, 30.0, 500))
    assert list(read.models) == list(trained.models)
    for kind, model in trained.models.items():
        right = Inverse(model, 1e-3).run(wanted)
        assert Inverse(read.models[kind], 1e-3).run(wanted).tolist() == right.tolist()


def damaged(change):
    def make(path):
        document = json.loads(path.read_text("utf-8"))
        change(document)
        path.write_text(json.dumps(document), "utf-8")

    return make


@pytest.mark.parametrize(
    ("damage", "message"),
    [
        (lambda path: path.write_text("{"), "zn.json: the file: Invalid JSON"),
        (lambda path: path.write_bytes(b"\x80\x04\x95pickle"), "zn.json: the file: Invalid JSON"),
        (lambda path: path.write_bytes(b" " * 5_000_000), "larger than 4000000 bytes"),
        (lambda path: path.unlink(), "cannot be read"),
        (damaged(lambda d: d.update(rotemina_inverse=2)), "rotemina_inverse: Input should be 1"),
        (damaged(lambda d: d.update(more=1)), "more: Extra inputs are not permitted"),
        (damaged(lambda d: d.pop("axis")), "axis: Field required"),
        (damaged(lambda d: d.update(recommended="best")), "recommended: Input should be"),
        (damaged(lambda d: d["inverses"].pop()), "of the same kinds"),
        (damaged(lambda d: d["inverses"][0].update(span=0.0)), "inverses.0.span: Input should be"),
        (damaged(lambda d: d["inverses"][0].update(span="1")), "inverses.0.span: Input should be"),
        (damaged(lambda d: d["inverses"][0]["radii"].pop()), "initial: 12 entries where 11 belong"),
        (
            damaged(lambda d: d["inverses"][0]["consequents"].pop()),
            "consequents: 4 entries where 5",
        ),
        (
            damaged(lambda d: d["inverses"][0]["premises"]["widths"][0].pop()),
            "every row must hold 5 memberships",
        ),
        (
            damaged(lambda d: d["inverses"][0].update(desired_range=[1.0, 0.0])),
            "desired_range: 1 must lie below 0",
        ),
    ],
)
def test_a_bad_file_is_refused_with_its_place(damage, message, path):
    damage(path)
    with pytest.raises(CompensationError, match=message):
        read_trained(path)


def test_numbers_that_are_none_are_refused(path):
    path.write_text(path.read_text("utf-8").replace('"lag_s": ', '"lag_s": NaN, "x": ', 1), "utf-8")
    with pytest.raises(CompensationError, match="lag_s"):
        read_trained(path)


def test_a_place_that_cannot_be_written_is_said(tmp_path, trained):
    with pytest.raises(InputError, match="cannot be written"):
        write_trained(tmp_path / "no" / "zn.json", trained, PROVENANCE)
