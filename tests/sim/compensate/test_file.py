"""The file of inverses: the same commands after reading, and the errors of a bad file."""

import json

import numpy as np
import pytest

from rotemina.sim.compensate import (
    Inverse,
    InverseProvenance,
    InverseSource,
    read_trained,
    write_trained,
)
from rotemina.sim.errors import CompensationError, InputError

SOURCE = InverseSource(name="a.csv", sha256="0" * 64, rows=100)
PROVENANCE = InverseProvenance(
    robot="RoTeMiNa", trained_on=[SOURCE], held_out=[], seed=None, versions={"numpy": "2"}
)


@pytest.fixture
def path(tmp_path, trained):
    write_trained(tmp_path / "zn.json", trained, PROVENANCE)
    return tmp_path / "zn.json"


def test_inverses_that_were_read_give_the_same_commands(path, trained):
    restored, provenance = read_trained(path)
    assert provenance == PROVENANCE
    assert restored.residuals == trained.residuals
    assert (restored.recommended_kind, restored.recommendation_reason, restored.remarks) == (
        trained.recommended_kind,
        trained.recommendation_reason,
        trained.remarks,
    )
    desired = 30e-6 + 20e-6 * np.sin(np.linspace(0.0, 30.0, 500))
    assert list(restored.models) == list(trained.models)
    for kind, model in trained.models.items():
        expected = Inverse(model, 1e-3).run(desired)
        assert Inverse(restored.models[kind], 1e-3).run(desired).tolist() == expected.tolist()


def edit(change):
    """Return a function that changes the JSON document of a file."""

    def damage(path):
        document = json.loads(path.read_text("utf-8"))
        change(document)
        path.write_text(json.dumps(document), "utf-8")

    return damage


def edit_first(**values):
    """Return a function that changes fields of the first inverse of a file."""
    return edit(lambda document: document["inverses"][0].update(values))


@pytest.mark.parametrize(
    ("damage", "message"),
    [
        (lambda path: path.write_text("{"), "zn.json: the file: Invalid JSON"),
        (lambda path: path.write_bytes(b"\x80\x04\x95pickle"), "zn.json: the file: Invalid JSON"),
        (lambda path: path.write_bytes(b" " * 5_000_000), "larger than 4000000 bytes"),
        (lambda path: path.unlink(), "cannot be read"),
        (edit(lambda d: d.update(rotemina_inverse=2)), "rotemina_inverse: Input should be 1"),
        (edit(lambda d: d.update(more=1)), "more: Extra inputs are not permitted"),
        (edit(lambda d: d.pop("axis")), "axis: Field required"),
        (edit(lambda d: d.update(recommended="best")), "recommended: Input should be"),
        (edit(lambda d: d["inverses"].pop()), "of the same kinds"),
        (edit_first(span=0.0), "inverses.0.span: Input should be"),
        (edit_first(span="1"), "inverses.0.span: Input should be"),
        (edit_first(lag_s=float("nan")), "lag_s"),
        (edit_first(desired_range=[1.0, 0.0]), "desired_range: 1 must lie below 0"),
        (edit(lambda d: d["inverses"][0]["radii"].pop()), "initial: 12 entries instead of 11"),
        (
            edit(lambda d: d["inverses"][0]["consequents"].pop()),
            "consequents: 4 entries instead of 5",
        ),
        (
            edit(lambda d: d["inverses"][0]["premises"]["widths"][0].pop()),
            "every row must hold 5 memberships",
        ),
    ],
)
def test_a_bad_file_is_refused_with_the_place_of_the_error(damage, message, path):
    damage(path)
    with pytest.raises(CompensationError, match=message):
        read_trained(path)


def test_a_path_that_cannot_be_written_is_an_error(tmp_path, trained):
    with pytest.raises(InputError, match="cannot be written"):
        write_trained(tmp_path / "no" / "zn.json", trained, PROVENANCE)
