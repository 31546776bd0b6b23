"""Each test of a command runs in an empty folder."""

import pytest

from rotemina.app.cli.main import main


@pytest.fixture(autouse=True)
def in_tmp(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def get_refusal(in_tmp, capsys):
    """Function that runs a refused command, and returns the line that it prints.

    The command writes no file, and changes none.
    """

    def read_files():
        return {path: path.is_file() and path.read_bytes() for path in in_tmp.rglob("*")}

    def run(arguments):
        capsys.readouterr()
        before = read_files()
        assert main(arguments.split() if isinstance(arguments, str) else arguments) == 2
        output = capsys.readouterr()
        assert output.out == ""
        assert output.err.startswith("rotemina: ")
        assert output.err.count("\n") == 1
        assert read_files() == before
        return output.err

    return run
