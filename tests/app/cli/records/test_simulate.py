"""``rotemina simulate`` from the command line."""

import csv
from functools import partial
from pathlib import Path

import numpy as np
import pytest

from rotemina.app.cli.main import main
from rotemina.sim.records import PIECE_ROWS, Record, Tap, read_pieces, read_record, write_record
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot, read_robot_file
from rotemina.sim.simulation import SimulatedMachine, simulate

ROBOT = load_robot("rotemina")
EFFECTS = """
[[axis.thx.effect]]
id = "hysteresis"

[[axis.x.effect]]
id = "friction"
formulation = "lugre"
"""


@pytest.fixture
def robot_with_effects():
    """Write a user's robot file with effects and return its name."""
    Path("own.toml").write_text(read_robot_file("rotemina") + EFFECTS, "utf-8")
    return "own.toml"


def make_commands(rows=2000, axes=("x", "thx"), **metadata):
    time_s = np.arange(rows) / 1000
    swing = 0.5 + 0.3 * np.sin(9.0 * time_s) * np.minimum(time_s, 1.0)
    signals = {(a, Tap.CMD): min(ROBOT.axes[a].span, 1e-3) * swing for a in axes}
    return Record.from_signals(time_s, signals, {a: ROBOT.unit(a) for a in axes}, metadata)


def write_commands(name="c.csv", **options):
    record = make_commands(**options)
    write_record(record, name)
    return record


def is_bitwise_equal(left, right):
    return left.columns == right.columns and left.values.tobytes() == right.values.tobytes()


def test_record_matches_the_simulation_of_the_machine(robot_with_effects, capsys):
    commands = write_commands(note="n")
    assert main(["simulate", "c.csv", "--robot", robot_with_effects, "-o", "r.csv"]) == 0
    assert capsys.readouterr().out == "r.csv: 2000 rows, 1.999 s\n"
    record = read_record("r.csv")
    column_names = ["x.cmd", "x.ref", "x.meas", "thx.cmd", "thx.u", "thx.ref", "thx.meas"]
    assert [str(column) for column in record.columns] == column_names
    expected = simulate(load_robot(robot_with_effects), None, commands, np.random.default_rng(0))
    assert is_bitwise_equal(record, expected)
    assert not is_bitwise_equal(record, simulate(ROBOT, (), commands, np.random.default_rng(0)))
    assert main(["compare", "r.csv"]) == 0


def test_record_metadata_describes_the_simulation(robot_with_effects):
    write_commands(note="n", history="unknown", **{"simulated effect 7": "of another time"})
    arguments = ["simulate", "c.csv", "--robot", robot_with_effects, "--seed", "4", "-o", "r.csv"]
    assert main(arguments) == 0
    record = read_record("r.csv")
    # A machine whose past is unknown was at rest.
    assert record.history == "rest"
    metadata = record.metadata
    assert metadata["note"] == "n"
    assert metadata["simulated robot"] == "RoTeMiNa"
    assert metadata["simulated seed"] == "4"
    assert metadata["simulated effect 1"].startswith("friction on x; lugre; ")
    assert metadata["simulated effect 2"].startswith("hysteresis on thx; ")
    assert "simulated effect 7" not in metadata
    assert main(["simulate", "c.csv", "--no-noise", "-o", "r.csv"]) == 0
    metadata = read_record("r.csv").metadata
    assert metadata["simulated seed"] == "none"
    assert not [key for key in metadata if "effect" in key]


def test_simulated_record_can_be_simulated_again_from_its_commands(robot_with_effects):
    write_commands()
    assert main(["simulate", "c.csv", "--robot", robot_with_effects, "-o", "a.csv"]) == 0
    assert main(["simulate", "a.csv", "--robot", robot_with_effects, "-o", "b.csv"]) == 0
    assert Path("a.csv").read_bytes() == Path("b.csv").read_bytes()


def test_seed_option_and_no_noise():
    commands = write_commands()
    for name, options in (
        ("usual", []),
        ("zero", ["--seed", "0"]),
        ("one", ["--seed", "1"]),
        ("none", ["--no-noise"]),
    ):
        assert main(["simulate", "c.csv", *options, "-o", f"{name}.csv"]) == 0
    assert Path("usual.csv").read_bytes() == Path("zero.csv").read_bytes()
    assert not is_bitwise_equal(read_record("usual.csv"), read_record("one.csv"))
    assert is_bitwise_equal(read_record("none.csv"), simulate(ROBOT, (), commands))


def test_effects_of_another_robot_file(robot_with_effects):
    commands = write_commands()
    assert main(["simulate", "c.csv", "--effects", robot_with_effects, "-o", "with.csv"]) == 0
    arguments = ["--robot", robot_with_effects, "--effects", "rotemina", "-o", "without.csv"]
    assert main(["simulate", "c.csv", *arguments]) == 0
    make_rng = np.random.default_rng
    assert is_bitwise_equal(
        read_record("with.csv"),
        simulate(load_robot(robot_with_effects), None, commands, make_rng(0)),
    )
    assert is_bitwise_equal(read_record("without.csv"), simulate(ROBOT, (), commands, make_rng(0)))


@pytest.mark.parametrize(("name", "output"), [("c.csv", "r.csv.gz"), ("c.csv.gz", "r.csv")])
def test_long_file_streams_to_the_same_bits(monkeypatch, robot_with_effects, name, output):
    """Three pieces, the last one short. State and random streams continue between them."""
    commands = write_commands(name, rows=2 * PIECE_ROWS + 100, axes=("thx",))
    expected = simulate(load_robot(robot_with_effects), None, commands, np.random.default_rng(0))
    # The file must not be read as a whole.
    monkeypatch.setattr("rotemina.app.cli.records.simulate.read_record", None)
    assert main(["simulate", name, "--robot", robot_with_effects, "-o", output]) == 0
    assert Path(output).read_bytes().startswith(b"\x1f\x8b") == output.endswith(".gz")
    assert is_bitwise_equal(read_record(output), expected)


def make_leading_clock_effects():
    return [AxisEffect(axis="thx", id="clock_skew", parameters={"skew": -1000.0})]


@pytest.mark.parametrize("reason", ["periodic", "a clock that leads"])
def test_simulation_that_looks_ahead_reads_the_whole_file(reason):
    rows = PIECE_ROWS + 1000
    metadata = {"history": "periodic", "period_samples": str(rows)} if reason == "periodic" else {}
    commands = write_commands(rows=rows, axes=("thx",), **metadata)
    effects, options = (), []
    if not metadata:
        effects, options = make_leading_clock_effects(), ["--effects", "leads.toml"]
        Path("leads.toml").write_text(
            '[robot]\nname = "a"\naxes = ["thx"]\n[axis.thx]\nkind = "piezo"\nrange = [0.0, 1.0]\n'
            'gain = 1.0\nstatic = true\n[[axis.thx.effect]]\nid = "clock_skew"\nskew = -1000.0\n'
        )
    assert main(["simulate", "c.csv", *options, "-o", "r.csv"]) == 0
    assert is_bitwise_equal(
        read_record("r.csv"), simulate(ROBOT, effects, commands, np.random.default_rng(0))
    )
    if metadata:
        assert read_record("r.csv").history == "periodic"


def test_command_outside_its_range_is_simulated_and_reported(capsys):
    time_s = np.arange(4) / 1000
    signals = {("x", Tap.CMD): np.array([0.05, 0.0551, 0.056, 0.05])}
    write_record(Record.from_signals(time_s, signals, {"x": "m"}), "c.csv")
    assert main(["simulate", "c.csv", "-o", "r.csv"]) == 0
    assert capsys.readouterr().err == (
        "Model: RoTeMiNa (built in); choose another with --robot\n"
        "rotemina: c.csv: x.cmd = 0.0551 at row 2 (t = 0.001 s) is outside 0 … 0.055 m; "
        "2 such rows\n"
    )
    assert read_record("r.csv").signal("x", Tap.CMD)[2] == 0.056


def test_row_numbers_count_from_the_first_piece(capsys):
    rows = PIECE_ROWS + 10
    command = np.full(rows, 0.02)
    command[-3:] = -0.001
    signals = {("x", Tap.CMD): command}
    write_record(Record.from_signals(np.arange(rows) / 1000, signals, {"x": "m"}), "c.csv")
    assert main(["simulate", "c.csv", "-o", "r.csv"]) == 0
    message = f"x.cmd = -0.001 at row {rows - 2} (t = {(rows - 3) / 1000:.9g} s)"
    assert message in capsys.readouterr().err


def test_invalid_value_in_a_later_piece_leaves_no_file(get_refusal):
    write_commands(rows=PIECE_ROWS + 5000, axes=("thx",))
    lines = Path("c.csv").read_text().splitlines()
    index = PIECE_ROWS + 4000
    lines[index] = lines[index].split(",")[0] + ",nan"
    Path("c.csv").write_text("\n".join(lines) + "\n")
    message = f"c.csv:{index + 1}:thx.cmd: value 'nan' is not finite; write a finite number"
    assert message in get_refusal("simulate c.csv --loads l.csv -o r.csv")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ("none.csv -o r.csv", "none.csv cannot be read (file not found)"),
        ("c.csv -o r.csv --robot nobody", "nobody: no such robot"),
        ("c.csv -o r.csv --robot emps", "robot 'EMPS' has no axis 'x'"),
        ("c.csv -o r.csv --effects q.toml", "q.toml: on robot 'RoTeMiNa': axis.q.effect delay"),
        ("c.csv -o r.csv --seed -1", "--seed -1: must be 0 or more"),
        ("c.csv -o r.csv --loads r.csv", "r.csv is named twice"),
        ("c.csv -o r.csv --loads ./c.csv", "c.csv is named twice"),
        ("c.csv --effects q.toml -o r.csv --loads q.toml", "q.toml is named twice"),
        ("c.csv -o r.csv --loads no/such/l.csv", "no/such/l.csv cannot be written"),
        ("p.csv -o r.csv", "period_samples = 5000: the record has only 2000 rows"),
    ],
)
def test_bad_request_is_refused(arguments, message, get_refusal):
    write_commands()
    write_commands("p.csv", history="periodic", period_samples="5000")
    Path("q.toml").write_text(
        '[robot]\nname = "q"\naxes = ["q"]\n[axis.q]\nkind = "piezo"\nrange = [0.0, 1.0]\n'
        'gain = 1.0\nstatic = true\n[[axis.q.effect]]\nid = "delay"\n'
    )
    assert message in get_refusal(f"simulate {arguments}")


def test_seed_and_no_noise_exclude_each_other(capsys):
    with pytest.raises(SystemExit) as exit_info:
        main(["simulate", "c.csv", "-o", "r.csv", "--seed", "1", "--no-noise"])
    assert exit_info.value.code == 2
    assert "not allowed with" in capsys.readouterr().err


def test_loads_are_written_as_a_table_with_units(robot_with_effects):
    write_commands()
    options = ["--robot", robot_with_effects, "--no-noise", "--loads", "l.csv"]
    assert main(["simulate", "c.csv", *options, "-o", "r.csv"]) == 0
    with Path("l.csv").open(newline="") as file:
        heading, *rows = csv.reader(file)
    column = {name: index for index, name in enumerate(heading)}
    table, record = np.array(rows, dtype=float), read_record("r.csv")
    assert table.shape == (2000, len(heading))
    assert heading[:5] == [
        "t [s]",
        "x position [m]",
        "x velocity [m/s]",
        "x acceleration [m/s2]",
        "x inertia [N]",
    ]
    assert "thx impulse [N m s]" in column
    assert heading[-2:] == ["kinetic energy [J]", "elastic energy [J]"]
    assert table[:, 0].tolist() == record.time_s.tolist()
    positions = table[:, column["thx position [rad]"]]
    assert positions.tolist() == record.signal("thx", Tap.REF).tolist()
    for axis, force in (("x", "N"), ("thx", "N m"), ("thy", "N m")):  # thy is coupled to thx
        terms = {
            name: table[:, column[f"{axis} {name} [{force}]"]]
            for name in (
                ["inertia", "damping", "stiffness", "actuation", "constant", "perturbation", "rest"]
            )
        }
        left = terms["inertia"] + terms["damping"] + terms["stiffness"]
        right = terms["actuation"] + terms["constant"] + terms["perturbation"] + terms["rest"]
        assert np.abs(left - right).max() <= 1e-12 * np.abs(terms["stiffness"]).max()
    assert table[:, column["x rest [N]"]].any()  # friction


def test_loads_of_a_long_file_are_the_same_in_pieces(monkeypatch):
    """Reading in pieces gives the same rows as reading the whole file."""
    write_commands(rows=1000, axes=("zn",))
    assert main(["simulate", "c.csv", "--loads", "whole.csv.gz", "-o", "r.csv"]) == 0
    small = partial(read_pieces, rows=97)
    monkeypatch.setattr("rotemina.app.cli.records.simulate.read_pieces", small)
    assert main(["simulate", "c.csv", "--loads", "pieces.csv", "-o", "r2.csv"]) == 0
    whole = np.loadtxt("whole.csv.gz", delimiter=",", skiprows=1)
    pieces = np.loadtxt("pieces.csv", delimiter=",", skiprows=1)
    # Differences of balanced forces of about 10⁵ N carry the rounding errors of those forces.
    assert pieces == pytest.approx(whole, rel=1e-6, abs=2e-14 * np.abs(whole).max())


def test_static_axes_have_no_force_columns():
    Path("s.toml").write_text(
        '[robot]\nname = "s"\naxes = ["q"]\n[axis.q]\nkind = "piezo"\nrange = [0.0, 1.0]\n'
        "gain = 1.0\nstatic = true\n"
    )
    Path("c.csv").write_text("t [s],q [rad]\n0,0.1\n1,0.2\n")
    assert main(["simulate", "c.csv", "--robot", "s.toml", "--loads", "l.csv", "-o", "r.csv"]) == 0
    assert Path("l.csv").read_text() == (
        "t [s],q position [rad],q velocity [rad/s],q acceleration [rad/s2],"
        "kinetic energy [J],elastic energy [J]\n"
        "0.0,0.1,0.1,0.1,0.0,0.0\n1.0,0.2,0.1,0.0,0.0,0.0\n"
    )


def test_interrupt_leaves_no_file(capsys, monkeypatch):
    write_commands(rows=PIECE_ROWS + 10, axes=("thx",))
    respond, calls = SimulatedMachine.respond, []

    def interrupt_second_call(self, commands):
        calls.append(len(commands.time_s))
        if len(calls) == 2:
            raise KeyboardInterrupt
        return respond(self, commands)

    monkeypatch.setattr(SimulatedMachine, "respond", interrupt_second_call)
    assert main(["simulate", "c.csv", "--loads", "l.csv", "-o", "r.csv"]) == 130
    assert capsys.readouterr().err.splitlines()[-1] == "rotemina: interrupted"
    assert calls == [PIECE_ROWS, 10]
    assert [path.name for path in Path().iterdir()] == ["c.csv"]


def test_progress_is_shown_on_a_terminal(capsys, monkeypatch):
    write_commands(axes=("thx",))
    monkeypatch.setattr("sys.stderr.isatty", lambda: True, raising=False)
    assert main(["simulate", "c.csv", "-o", "r.csv"]) == 0
    model, progress = capsys.readouterr().err.split("\n", 1)
    assert model == "Model: RoTeMiNa (built in); choose another with --robot"
    assert progress == "\rsimulated 2.0 s\n"


def test_inactive_effect_is_reported_and_not_in_the_metadata(capsys, tmp_path):
    write_commands(rows=100, axes=("zn",))
    Path("worn.toml").write_text(
        read_robot_file("rotemina")
        + '[[axis.y.effect]]\nid = "backlash"\n[[axis.zn.effect]]\nid = "delay"\n',
        "utf-8",
    )
    assert main(["simulate", "c.csv", "--robot", "worn.toml", "-o", "r.csv"]) == 0
    assert "effect backlash on axis y does not act" in capsys.readouterr().err
    metadata = read_record("r.csv").metadata
    assert [text for key, text in metadata.items() if key.startswith("simulated effect")] == [
        metadata["simulated effect 1"]
    ]
    assert "delay on zn" in metadata["simulated effect 1"]
