"""Nothing that an operator does in a day holds up the window: the thread's own work is measured.

Absolute times depend on the machine and on what else runs on it. A change of theme in the same run,
from the request until all is painted, is the measure: no turn of the event loop may take more than
a tenth of its processor time.
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
LIMIT = 0.1
#: What takes longer, by how its step begins: its share of a change of theme, and why. A figure may
#: only become smaller.
LONGER = {
    "start": (0.2, "a panel with several plots or many fields is made, or dressed, in one call"),
    "layout": (0.2, "Qt lays out and paints all panels of a layout, but the plots, in one go"),
    "resize": (0.2, "Qt lays out and paints all panels of a layout, but the plots, in one go"),
    "keys": (0.13, "Qt lays out the table of all shortcuts in one call"),
    "open a long record": (0.15, "Python's garbage collector looks through all objects once"),
}

pytestmark = [pytest.mark.slow, pytest.mark.xdist_group("screen")]


def day(folder, part):
    """Return the turns of a part of the day with their shares of a change of theme."""
    folder.mkdir()
    own = {f"XDG_{kind}_HOME": str(folder / kind) for kind in ("DATA", "CONFIG", "CACHE")}
    done = subprocess.run(
        [sys.executable, DAY, folder, part],
        check=False,
        capture_output=True,
        text=True,
        timeout=600,
        env={**os.environ, **own},
    )
    assert done.returncode == 0, done.stderr[-4000:]
    found = json.loads((folder / f"{part}.json").read_text("utf-8"))
    assert not found["failure"], found["failure"]
    themes = defaultdict(float)
    for turn in found["turns"]:
        if turn["label"].startswith("theme "):
            themes[turn["label"]] += turn["busy_s"]
    assert len(themes) == 3
    whole_s = median(themes.values())
    others = [turn for turn in found["turns"] if turn["label"] not in themes]
    return [{**turn, "share": turn["busy_s"] / whole_s} for turn in others]


def limit_of(label):
    return next((limit for begin, (limit, _) in LONGER.items() if label.startswith(begin)), LIMIT)


def too_long(turns):
    above = [turn for turn in turns if turn["share"] > limit_of(turn["label"])]
    return sorted(above, key=lambda turn: -turn["share"])


def as_text(turns):
    lines = []
    for turn in turns:
        lines.append(
            f"{turn['label']}: {turn['share']:.2f} of a change of theme, {turn['busy_s']:.3f} s of"
            f" the processor in {turn['lasted_s']:.3f} s"
        )
        lines += [f"    {times} times in {calls}" for calls, times in turn["calls"]]
    return "\n".join(lines)


@pytest.mark.parametrize("part", ["window", "work", "devices"])
def test_no_turn_of_the_loop_takes_a_tenth_of_a_change_of_theme(part, tmp_path):
    above = too_long(day(tmp_path / "0", part))
    for number in (1, 2):  # a busy machine makes a thread's own work slower, too: what comes again
        if above:
            again = {turn["label"] for turn in too_long(day(tmp_path / str(number), part))}
            above = [turn for turn in above if turn["label"] in again]
    assert not above, as_text(above)
