"""Real machines laid out for ``gap bench``. Usage: laid_out.py DATA OUT

Those that come as record files are taken as they are; the others are converted first, and are of
the shipped robot of their name.
"""

import runpy
import shutil
import sys
from importlib import resources
from pathlib import Path
from tempfile import TemporaryDirectory

# Which converted records are diagnosed, and which are kept back: as the truth.toml of each says.
CONVERTED = {
    "emps": (["emps_train"], ["emps_pulses"]),
    "picma": (["picma_train"], ["picma_growing"]),
    "fsm": (
        [f"fsm_200mV_train_{number}" for number in range(6)],
        [f"fsm_200mV_test_{number}" for number in range(3)],
    ),
}


def lay_out(data: Path, out: Path) -> None:
    """Make a folder for each machine."""
    for machine in (data / "machines").iterdir():
        if (machine / "robot.toml").is_file():
            shutil.copytree(machine, out / machine.name)
    with TemporaryDirectory() as folder:
        arguments, sys.argv = sys.argv, ["convert.py", folder]
        try:
            runpy.run_path(str(data / "convert.py"), run_name="__main__")
        finally:
            sys.argv = arguments
        robots = resources.files("rotemina.resources.robots")
        for name, parts in CONVERTED.items():
            place = out / name
            place.mkdir(parents=True)
            (place / "robot.toml").write_bytes(robots.joinpath(f"{name}.toml").read_bytes())
            shutil.copyfile(data / name / "truth.toml", place / "truth.toml")
            for part, records in zip(("train", "test"), parts, strict=True):
                for number, record in enumerate(records, start=1):
                    shutil.move(Path(folder) / f"{record}.csv", place / f"{part}_{number}.csv")


if __name__ == "__main__":
    lay_out(Path(sys.argv[1]), Path(sys.argv[2]))
