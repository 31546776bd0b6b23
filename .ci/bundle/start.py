"""What the bundle starts: the command ``rotemina``.

The program also starts processes of its own by ``sys.executable -m MODULE`` and ``-c CODE`` (the
window of the 3-D view, the workers of a diagnosis). In a bundle that is this program, so it answers
to both, as Python would.
"""

import multiprocessing
import runpy
import sys


def main() -> int:
    """Do what Python would with ``-m`` and ``-c``, and everything else as ``rotemina``."""
    multiprocessing.freeze_support()
    words = [word for word in sys.argv[1:] if word not in ("-B", "-E", "-I", "-s", "-u")]
    if words[:1] == ["-m"]:
        sys.argv = words[1:]
        runpy.run_module(words[1], run_name="__main__", alter_sys=True)
        return 0
    if words[:1] == ["-c"]:
        sys.argv = ["-c", *words[2:]]
        exec(words[1], {"__name__": "__main__"})  # noqa: S102 - our own processes' code
        return 0
    from rotemina.app.cli.main import main as rotemina

    return rotemina()


if __name__ == "__main__":
    sys.exit(main())
