"""Every benchmark runs, in its short form."""

import subprocess
import sys
from pathlib import Path

import pytest

FOLDER = Path(__file__).parent
# The test of long use runs this one.
ELSEWHERE = "bench_memory.py"


@pytest.mark.slow
@pytest.mark.parametrize(
    "name", sorted({file.name for file in FOLDER.glob("bench_*.py")} - {ELSEWHERE})
)
def test_a_benchmark_runs(name, tmp_path):
    for package in ("pandas", "psutil"):
        pytest.importorskip(package, reason="comes with the extra 'bench'")
    page = tmp_path / "benchmarks.md"
    process = subprocess.run(
        [
            *(sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider"),
            *("--override-ini", "python_files=bench_*.py", "--quick", f"--page={page}"),
            str(FOLDER / name),
        ],
        cwd=FOLDER.parents[1],
        capture_output=True,
        text=True,
        check=False,
    )
    assert process.returncode == 0, process.stdout + process.stderr
    assert f"`tests/benchmarks/{name}`" in page.read_text("utf-8")
