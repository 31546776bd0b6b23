"""No action of an operator's day blocks the window; the processor time of its thread is measured.

Absolute times depend on the computer and its load. The reference is a change of theme in the same
run, from the request until everything is painted: no turn of the event loop may take more than a
tenth of its processor time.
"""

import json
import os
import subprocess
import sys
from collections import defaultdict
from pathlib import Path
from statistics import median

import pytest

DAY = Path(__file__).with_name("day.py")
DEFAULT_LIMIT = 0.1
#: Exceptions by the start of the step's label: the limit as a share of a change of theme, and the
#: reason. A limit may only be lowered.
EXCEPTIONS = {
    "start": (0.2, "a panel with several plots or many fields is made or styled in one call"),
    "layout": (0.2, "Qt lays out and paints all panels of a layout, except the plots, in one go"),
    "resize": (0.2, "Qt lays out and paints all panels of a layout, except the plots, in one go"),
    "keys": (0.13, "Qt lays out the table of all shortcuts in one call"),
    "open a long record": (0.15, "Python's garbage collector looks through all objects once"),
}

pytestmark = [pytest.mark.slow, pytest.mark.xdist_group("screen")]


def run_day(folder, part):
    """Return the turns of a part of the day with their shares of a change of theme."""
    folder.mkdir()
    folders = {f"XDG_{kind}_HOME": str(folder / kind) for kind in ("DATA", "CONFIG", "CACHE")}
    process = subprocess.run(
        [sys.executable, DAY, folder, part],
        check=False,
        capture_output=True,
        text=True,
        timeout=600,
        env={**os.environ, **folders},
    )
    assert process.returncode == 0, process.stderr[-4000:]
    result = json.loads((folder / f"{part}.json").read_text("utf-8"))
    assert not result["failure"], result["failure"]
    themes = defaultdict(float)
    for turn in result["turns"]:
        if turn["label"].startswith("theme "):
            themes[turn["label"]] += turn["busy_s"]
    assert len(themes) == 3
    theme_change_s = median(themes.values())
    other_turns = [turn for turn in result["turns"] if turn["label"] not in themes]
    return [{**turn, "share": turn["busy_s"] / theme_change_s} for turn in other_turns]


def find_limit(label):
    return next(
        (limit for start, (limit, _) in EXCEPTIONS.items() if label.startswith(start)),
        DEFAULT_LIMIT,
    )


def find_slow_turns(turns):
    slow_turns = [turn for turn in turns if turn["share"] > find_limit(turn["label"])]
    return sorted(slow_turns, key=lambda turn: -turn["share"])


def format_turns(turns):
    lines = []
    for turn in turns:
        lines.append(
            f"{turn['label']}: {turn['share']:.2f} of a change of theme, {turn['busy_s']:.3f} s of"
            f" the processor in {turn['lasted_s']:.3f} s"
        )
        lines += [f"    {times} times in {calls}" for calls, times in turn["calls"]]
    return "\n".join(lines)


@pytest.mark.parametrize("part", ["window", "work", "devices"])
def test_no_turn_of_the_loop_exceeds_its_share_of_a_theme_change(part, tmp_path):
    slow_turns = find_slow_turns(run_day(tmp_path / "0", part))
    for number in (1, 2):  # load slows the thread too, so only repeated excesses count
        if slow_turns:
            slow_labels = {
                turn["label"] for turn in find_slow_turns(run_day(tmp_path / str(number), part))
            }
            slow_turns = [turn for turn in slow_turns if turn["label"] in slow_labels]
    assert not slow_turns, format_turns(slow_turns)
