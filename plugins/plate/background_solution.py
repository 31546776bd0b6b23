"""Solver of a plate in the background."""

from PySide6.QtCore import QObject, Signal

from rotemina.app.workbench import BackgroundJob, ReportProgress
from rotemina.plugins.plate import mark
from rotemina.plugins.plate.coloured_quantities import QUANTITIES
from rotemina.plugins.plate.solution import SolvedPlate, solve_plate
from rotemina.plugins.plate.surface_drawing import OrbitView, draw_surface
from rotemina.plugins.plate.surface_picture import make_static_picture
from rotemina.sim.robot import Robot


class BackgroundPlateSolver(QObject):
    """Solver of one plate at a time. A stop takes effect at the end of a stage.

    Signals
    -------
    progressed(str) : name of the stage that has begun.
    finished(SolvedPlate) : the solution.
    failed(str) : message of the error.
    """

    progressed = Signal(str)
    finished = Signal(object)
    failed = Signal(str)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._job = BackgroundJob(self)
        self._job.progressed.connect(self._on_progress)
        self._job.finished.connect(self.finished)
        self._job.failed.connect(self.failed)

    @property
    def running(self) -> bool:
        """Whether a plate is being solved."""
        return self._job.running

    def start(self, robot: Robot, divisions: int) -> None:
        """Solve the plate of a robot. A computation that is still running is stopped."""

        def work(report: ReportProgress) -> SolvedPlate:
            def report_stage(name: str) -> None:
                report(name, 0.0, None)

            solved = solve_plate(robot, divisions, report_stage)
            report_stage(mark("drawing"))
            # The first drawing compiles the rasteriser, which would block the window.
            picture = make_static_picture(solved, solved.ranges[:, 1], QUANTITIES[0], 1.0)
            draw_surface(picture.surface, OrbitView(), (8, 8), (0, 0, 0), (0, 0, 0), None)
            return solved

        self._job.start(work)

    def stop(self) -> None:
        """Stop, without waiting for the thread."""
        self._job.stop()

    def close(self) -> None:
        """Stop, and wait until the thread has ended."""
        self._job.close()

    def _on_progress(self, stage: str, _share: float, _report: object) -> None:
        self.progressed.emit(stage)
