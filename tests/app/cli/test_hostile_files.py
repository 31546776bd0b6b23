"""Unreadable files and impossible names: one clear line and status 2."""

import json
import os

import pytest

from rotemina.app.cli.main import main

LONG_NAME = "a" * 300
SHORTENED_NAME = f"{'a' * 100} … {'a' * 30} (300 characters)"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["compare", "good.csv", "--robot", "pipe"], "pipe cannot be read (it is a pipe"),
        (["gap", "predict", "pipe", "good.csv"], "pipe cannot be read (it is a pipe"),
        (["compensate", "apply", "pipe", "good.csv", "-o", "o.csv"], "pipe cannot be read"),
        (["calibrate", "show", "pipe"], "pipe cannot be read (it is a pipe"),
        (["recording", "info", "pipe"], "pipe cannot be read (it is a pipe"),
        (["recording", "recover", "pipe.part"], "pipe.part cannot be read (it is a pipe"),
        (
            ["tune", "--choose", "1", "-o", "/dev/zero"],
            "/dev/zero cannot be read (it is",
        ),
        (["convert", "good.csv", "-o", "good.csv/x.csv"], "good.csv/x.csv cannot be written"),
        (
            ["convert", "good.csv", "-o", f"{LONG_NAME}.csv"],
            ".csv (304 characters): File name too long",
        ),
        (["compare", LONG_NAME], f"{SHORTENED_NAME} cannot be read (File name too long)"),
        (["compare", "good.csv", "--robot", "deep.toml"], "deep.toml: tables or lists are nested"),
        (
            ["tune", "--axis", "zn", "-o", "o", "--population", "1000000000"],
            "population 10000000",
        ),
        (["tune", "--axis", "zn", "-o", "o", "--rate", "1e15"], "loop rate 1e+15 Hz"),
    ],
)
def test_unusable_file_gives_one_clear_line(arguments, message, tmp_path, get_refusal):
    (tmp_path / "good.csv").write_text("t [s],x.cmd [um],x.meas [um]\n0,0,0\n0.001,1,1\n")
    (tmp_path / "deep.toml").write_text(".".join(["a"] * 50_000) + " = 1")
    for name in ("pipe", "pipe.part"):
        os.mkfifo(tmp_path / name)
    assert message in get_refusal(arguments)


@pytest.mark.parametrize("value", ["k" * 100_000, "a\x1b[31mb\nc\rd" + "k " * 50_000])
@pytest.mark.parametrize(
    "arguments",
    [
        ["convert", "{}", "-o", "o.csv"],
        ["convert", "good.csv", "-o", "o.csv", "--robot", "{}"],
        ["convert", "good.csv", "-o", "o.csv", "--columns", "t [s], {} [m]"],
        ["convert", "good.csv", "-o", "o.csv", "--method", "{}"],
        ["convert", "good.csv", "-o", "o.csv", "--{}"],
        ["convert", "mode.csv", "-o", "o.csv"],
        ["convert", "good.csv", "-o", "o.csv", "--robot", "key.toml"],
        ["driver", "check", "{}"],
        ["driver", "check", "simulator", "--set", "{}=1"],
        ["driver", "check", "simulator", "--set", "seed={}"],
        ["plugin", "check", "{}"],
        ["effect", "show", "{}"],
        ["tune", "--axis", "{}", "-o", "o"],
        ["{}"],
    ],
)
def test_long_or_unprintable_value_is_quoted_shortened(arguments, value, tmp_path, capsys):
    (tmp_path / "good.csv").write_text("t [s],x.cmd [um]\n0,0\n0.001,1\n")
    (tmp_path / "mode.csv").write_text(f"# mode: {value}\nt [s],x.cmd [um]\n0,0\n0.001,1\n")
    (tmp_path / "key.toml").write_text(f"{json.dumps(value)} = 1\n")
    try:
        status = main([argument.format(value) for argument in arguments])
    except SystemExit as caught:
        status = caught.code
    assert status == 2
    error = capsys.readouterr().err
    assert len(error) < 2500
    assert all(line.isprintable() for line in error.split("\n"))
