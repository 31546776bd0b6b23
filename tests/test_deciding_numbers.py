"""The script that counts the numbers that decide in the diagnosis."""

import runpy
from pathlib import Path

SCRIPT = Path(__file__).parents[1] / ".ci" / "deciding_numbers.py"


def test_constants_count_once_and_equal_comparisons_once_a_function(tmp_path):
    script = runpy.run_path(str(SCRIPT))
    script["count_numbers"].__globals__["ROOT"] = tmp_path
    folder = tmp_path / "sim" / "gap"
    (folder / "fit").mkdir(parents=True)
    (folder / "limits.py").write_text("MIN_SHARE = 0.3\nMAX_STEPS = 4\n")
    (folder / "fit" / "steps.py").write_text(
        "from rotemina.sim.gap.limits import MIN_SHARE\n"
        "_FEW = 3\n"
        "def decide(share, count):\n"
        "    if share > MIN_SHARE or share <= MIN_SHARE or count < _FEW:\n"
        "        return count > 1 and count != 7 and 0.5 * share >= 0 or 0.5 * share >= 0\n"
        "    return share < 0.2\n"
    )
    (folder / "policy.py").write_text(
        "class Policy:\n    level: float = 0.9\n    rounds: int = 2\n    name: str = ''\n"
    )
    assert sorted(script["count_numbers"](folder).items()) == [
        ("MIN_SHARE", 2),
        ("policy: level", 1),
        ("policy: rounds", 1),
        ("sim/gap/fit/steps.py: _FEW", 1),
        ("sim/gap/fit/steps.py: decide: 0.5 * share >= 0: 0.5", 2),
        ("sim/gap/fit/steps.py: decide: share < 0.2: 0.2", 1),
    ]
