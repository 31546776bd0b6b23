"""Prepare folders of real machines for ``gap bench``. Usage: laid_out.py DATA OUT

Machines with record files are copied as they are. The others are converted first, and use the
included robot file of the same name.
"""

import runpy
import shutil
import sys
from importlib import resources
from pathlib import Path
from tempfile import TemporaryDirectory

# The converted records for diagnosis and for testing, as in the truth.toml of each machine.
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
            folder_of_machine = out / name
            folder_of_machine.mkdir(parents=True)
            (folder_of_machine / "robot.toml").write_bytes(
                robots.joinpath(f"{name}.toml").read_bytes()
            )
            shutil.copyfile(data / name / "truth.toml", folder_of_machine / "truth.toml")
            for part, records in zip(("train", "test"), parts, strict=True):
                for number, record in enumerate(records, start=1):
                    shutil.move(
                        Path(folder) / f"{record}.csv", folder_of_machine / f"{part}_{number}.csv"
                    )


if __name__ == "__main__":
    lay_out(Path(sys.argv[1]), Path(sys.argv[2]))
