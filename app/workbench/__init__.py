"""What window and panels share: the workbench with machine, plan, run and library, and its state.

Panels receive a workbench when they are created. It passes an operator's requests to the motion
session and refreshes the screen from one snapshot of the machine. The rest is in its parts:
``notice_poster`` for notices, ``job_runner`` for slow work, ``machine_monitor`` for the machine's
events, ``trajectory_planner`` for the loaded trajectory, ``playback_controller`` for playing it,
and ``record_manager`` for records and replays.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
