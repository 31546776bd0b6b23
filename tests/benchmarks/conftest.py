"""Options of the benchmarks: a short form, and a page with the results.

``--quick`` only checks that each benchmark still runs. It sets the names in a module's ``QUICK`` to
small sizes and unlimited times; the speed means nothing then. ``--page FILE`` writes the printed
results, with the machine, the date and the commit.
"""

import os
import platform
import shutil
import subprocess
from datetime import UTC, datetime
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
HEAD = """# Benchmarks

Compare the program's speed and memory with their limits. `make bench` writes this page. Ranges in
brackets are the spread over repetitions. Run one file on an idle machine:

<!-- not run: a measurement -->

    .venv/bin/pytest -s --override-ini python_files='bench_*.py' tests/benchmarks/bench_boards.py

{date}, commit {commit}; {machine}, load before {load}; Python {python}.
"""


def pytest_addoption(parser):
    parser.addoption(
        "--quick", action="store_true", help="run each benchmark as briefly as possible"
    )
    parser.addoption("--page", type=Path, metavar="FILE", help="write the results to a page")


def pytest_configure(config):
    config.printed = {}
    config.load = os.getloadavg()[0] if hasattr(os, "getloadavg") else float("nan")


def pytest_collection_modifyitems(config, items):
    if config.getoption("quick"):
        for item in items:
            for name, value in getattr(item.module, "QUICK", {}).items():
                assert hasattr(item.module, name), f"{item.module.__name__} has no {name}"
                setattr(item.module, name, value)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item, call):
    report = yield
    if call.when == "call":
        outputs = item.config.printed.setdefault(item.module, [])
        outputs.append(report.capstdout.strip("\n"))
        if report.outcome != "passed":
            outputs.append(f"{item.name}: {report.outcome}")
        item.config.get_terminal_writer().write(f"\n{report.capstdout}")
    return report


def pytest_sessionfinish(session):
    page = session.config.getoption("page")
    if page is not None:
        page.write_text(_page(session.config), "utf-8")


def _page(config):
    parts = [
        HEAD.format(
            machine=_machine(),
            load=f"{config.load:.1f}",
            python=f"{platform.python_version()}, {platform.system()}",
            date=f"{datetime.now(UTC):%Y-%m-%d}",
            commit=_commit(),
        )
    ]
    for module, outputs in config.printed.items():
        file = Path(module.__file__).relative_to(ROOT)
        title = (module.__doc__ or file.stem).split("\n\n")[0].replace("\n", " ")
        lines = [f"    {line}" for output in outputs for line in output.splitlines() if line]
        heading = f"## {title.split(': ')[0].rstrip('.')}\n\n`{file}`\n\n"
        parts.append(heading + "\n".join(lines) + "\n")
    return "\n".join(parts)


def _machine():
    """Return processor and memory, but not the machine's name, which is private."""
    info = Path("/proc/cpuinfo")
    lines = info.read_text("utf-8").splitlines() if info.exists() else []
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    memory_gb = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 2**30
    return (
        f"{names[0] if names else platform.machine()}, {os.cpu_count()} cores, {memory_gb:.0f} GB"
    )


def _commit():
    git = shutil.which("git")
    if git is None:
        return "unknown"
    processes = [
        subprocess.run([git, *words], cwd=ROOT, capture_output=True, text=True, check=False)
        for words in (("rev-parse", "--short=12", "HEAD"), ("status", "--porcelain", "-uno"))
    ]
    commit, changes = (process.stdout.strip() for process in processes)
    return f"{commit}, with changes" if changes else commit
