"""What an operator does in a day: each step with its name, what is done, and what is awaited."""

import logging
from functools import partial
from itertools import chain

import numpy as np
from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QApplication, QComboBox, QDialog, QTabWidget

from rotemina.app.motion.playback import PlaybackPhase
from rotemina.app.shell.layouts import BUILT_IN, DIAGNOSE, OPERATE, TUNE
from rotemina.app.shell.theme import THEMES
from rotemina.app.shell.workbench import Level
from rotemina.drivers.samples import DeviceState
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.records.writing import write_record
from rotemina.sim.trajectory.first_trajectory import example_for
from rotemina.sim.trajectory.worn_machine_demo import demonstration, worn_effects

ROWS = 200_000  # of a long record
ENTRIES = 500  # of the library
MESSAGES = 5000  # of the log
NOTICES = 100
SIZES = ((1000, 700), (1920, 1080), (1280, 800))
PAGES = ("index", "window", "gap-diagnosis", "safety", "effects", "plugins", "drivers", "paper")
THEME = "theme"


class Operator:
    """What an operator sees and has at hand."""

    def __init__(self, window, folder):
        self.window, self.bench, self.panels = window, window.workbench, window.panels
        self.folder = folder

    @property
    def rests(self):
        state = self.bench.session.snapshot()
        idle = state.activity is DeviceState.IDLE
        return state.locked is None and idle and not self.bench.busy

    def phase(self, phase):
        return lambda: self.bench.playback.state.phase is phase

    def is_on(self, *drivers):
        session = self.bench.session
        return session.driver.name in drivers and session.snapshot().connection == "connected"

    @property
    def recordings(self):
        return [one for one in self.bench.library.entries if one.kind == "recording"]

    def run_after(self, before):
        return lambda: self.bench.run is not before and self.rests

    def close_dialogs(self):
        for widget in QApplication.topLevelWidgets():
            if isinstance(widget, QDialog) and widget.isVisible():
                widget.close()


def soon():
    return True


def nothing():
    pass


def prepare(folder, robot, part):
    """Put what the library and the operator have from earlier days into a folder."""
    if part != "work":
        return
    played = folder / "data" / "played"
    played.mkdir(parents=True)
    time_s = np.arange(40) / 100.0
    signals = {("x", tap): 1e-3 * time_s for tap in (Tap.CMD, Tap.MEAS)}
    write_record(Record.from_signals(time_s, signals, {"x": "m"}), folder / "short.csv")
    text = (folder / "short.csv").read_bytes()
    for number in range(ENTRIES):
        when = f"2026-01-{1 + number // 24:02d}_{number % 24:02d}-00-00-000000"
        (played / f"{when}_x{number}.csv").write_bytes(text)
    write_record(long_record(robot), folder / "long.csv")


def long_record(robot):
    """Return a record of all axes of more than three minutes."""
    time_s = np.arange(ROWS) / 1000.0
    signals, units = {}, {}
    rng = np.random.default_rng(1)
    for number, (name, axis) in enumerate(robot.axes.items()):
        swing = 0.02 * axis.span * np.sin(2.0 * np.pi * (0.02 + 0.01 * number) * time_s)
        signals[name, Tap.CMD] = sum(axis.range) / 2.0 + swing
        noise = 1e-4 * axis.span * rng.standard_normal(ROWS)
        signals[name, Tap.MEAS] = signals[name, Tap.CMD] + noise
        units[name] = axis.unit
    return Record.from_signals(time_s, signals, units)


def start(op):
    late = op.window.late_panels
    yield "layout Tune at the start", partial(op.window.arrangement.arrange, TUNE), soon
    yield "start", nothing, lambda: not op.panels.waiting and not late._next.isActive()
    yield "connect", nothing, lambda: op.rests


def themes(op):
    """Change the theme, by which all else is measured, and change it back."""
    now = op.bench.theme.name
    for name in [*(other for other in THEMES if other != now), now]:
        yield f"{THEME} {name}", partial(op.window.use_theme, name), soon


def layouts(op):
    for layout in (*BUILT_IN, *BUILT_IN):
        yield f"layout {layout.word}", partial(op.window.arrangement.arrange, layout), soon
    for layout in BUILT_IN:
        yield f"layout {layout.word}", partial(op.window.arrangement.arrange, layout), soon
        for size in SIZES:
            yield f"resize {layout.word} to {size[0]}", partial(op.window.resize, *size), soon
    yield f"layout {OPERATE.word}", partial(op.window.arrangement.arrange, OPERATE), soon


def panels(op):
    for name, panel in op.panels.items():
        yield f"panel {name}", partial(op.window.bring_up, name), soon
        for tabs in panel.findChildren(QTabWidget):
            for at in range(tabs.count()):
                yield f"panel {name}, {tabs.tabText(at)}", partial(tabs.setCurrentIndex, at), soon


def windows(op):
    window = op.window
    for _ in range(2):
        yield "palette", window.toggle_palette, soon
        for letter in "plate":
            yield "palette, typing", partial(window.palette_page.field.insert, letter), soon
        yield "palette", window.toggle_palette, soon
    for page in PAGES:
        yield f"help {page}", partial(window.help_page.open_page, f"{page}.md"), soon
    yield "help", window.help_page.close, soon
    yield "keys", window.show_keys, soon
    yield "keys", op.close_dialogs, soon
    yield "choose a trajectory", window.ask_trajectory, soon
    yield "choose a trajectory", op.close_dialogs, soon


def messages(op):
    window, logger = op.window, logging.getLogger("day")

    def log(first):
        for number in range(first, first + 1000):
            text = f"message {number}"
            window.log.emit(logger.makeRecord("day", logging.WARNING, "", 0, text, (), None))

    def notify(first):
        for number in range(first, first + 10):
            level = Level.WARNING if number % 3 else Level.ERROR
            op.bench.notify(level, f"notice {number % 40} of many")

    for first in range(0, MESSAGES, 1000):
        yield "many messages", partial(log, first), soon
    yield "log", window.show_log, soon
    yield "log, search", partial(window.log_page.words.setText, "99"), soon
    yield "log", window.log_page.close, soon
    for first in range(0, NOTICES, 10):
        yield "many notices", partial(notify, first), soon
    path = op.folder / "support.zip"
    yield "support bundle", window.show_support, lambda: bool(window._support.items)
    yield "support bundle, save", lambda: window._support.write(path), path.exists
    yield "support bundle", lambda: window._support.close(), soon


def playback(op):
    bench, phase = op.bench, PlaybackPhase
    play = op.panels["trajectory"].transport.play
    yield "layout Operate", partial(op.window.arrangement.arrange, OPERATE), soon
    example = partial(bench.plan_trajectory, "example", example_for(bench.robot))
    yield "load the example", example, lambda: bench.plan is not None and op.rests
    yield "play", nothing, play.isEnabled
    yield "play", play.click, op.phase(phase.PLAYING)
    yield "play", nothing, play.isEnabled  # for half a second no press counts
    yield "pause", play.click, op.phase(phase.PAUSED)
    yield "pause", nothing, play.isEnabled
    yield "resume", play.click, op.phase(phase.PLAYING)
    yield "play to the end", nothing, op.run_after(None)
    yield "play", nothing, play.isEnabled
    yield "play", play.click, op.phase(phase.PLAYING)
    yield "end", bench.end_playback, lambda: op.rests


def diagnosis(op):
    bench, gap = op.bench, op.panels["gap"]
    worn = partial(bench.session.service.set_effects, worn_effects(bench.robot))
    yield "wear the machine", worn, lambda: op.rests
    motion = demonstration(bench.robot)
    plan = partial(bench.plan_trajectory, "worn", motion)
    yield "load a trajectory", plan, lambda: bench.plan.trajectory is motion and op.rests
    yield "play on a worn machine", bench.play, op.run_after(bench.run)
    yield "layout Diagnose", partial(op.window.arrangement.arrange, DIAGNOSE), soon
    yield "diagnose", nothing, gap.start.isEnabled
    yield "diagnose", gap.start.click, lambda: gap.answer is not None
    for at in range(gap.result.tabs.count()):
        yield f"diagnosis, tab {at}", partial(gap.result.tabs.setCurrentIndex, at), soon
    path = op.folder / "report.html"
    report = lambda: gap.actions_of.save_report(gap.answer, path)  # noqa: E731 (awaits the answer)
    yield "report", report, lambda: path.exists() and not bench.busy
    yield "use the corrected model", nothing, gap.result.use.isEnabled
    yield "use the corrected model", gap.result.use.click, lambda: op.rests
    for layout in BUILT_IN:
        yield f"layout {layout.word}", partial(op.window.arrangement.arrange, layout), soon
    yield "layout Operate", partial(op.window.arrangement.arrange, OPERATE), soon


def records(op):
    window, bench, recorder = op.window, op.bench, op.panels["recorder"]
    yield "panel recorder", partial(window.bring_up, "recorder"), soon
    toggle = recorder.recording.toggle
    yield "record", toggle, lambda: bench.operation.recording is not None
    stopped = lambda: bench.operation.recording is None and op.recordings  # noqa: E731 (awaited)
    yield "end of a recording", toggle, stopped
    replay = lambda: bench.open_replay(op.recordings[0].path)  # noqa: E731 (not there before)
    yield "replay", replay, lambda: bench.replaying.paced is not None
    yield "end of a replay", bench.replaying.end, soon
    long = partial(window.open_record, op.folder / "long.csv")
    yield "open a long record", long, op.run_after(bench.run)
    for name in ("comparison", "gap", "plots", "identification"):
        yield f"long record, {name}", partial(window.bring_up, name), soon
    view = op.panels["identification"].controls.view
    for at in range(view.count()):
        yield f"identification, {view.itemText(at)}", partial(view.setCurrentIndex, at), soon
    search = recorder.recordings.table.search
    yield "library", partial(window.bring_up, "recorder"), soon
    yield "library, search", partial(search.setText, "x4"), soon
    yield "library, all", search.clear, soon
    yield "choose a record", window.ask_record, soon
    yield "choose a record", op.close_dialogs, soon


def views(op):
    window, bench = op.window, op.bench
    view3d, plate = op.panels["view3d"], op.panels["plate"]
    bring_up = lambda name: partial(window.bring_up, name)  # noqa: E731 (an action)
    yield "panel view3d", bring_up("view3d"), lambda: view3d.canvas.painted > 3
    for view in view3d.views.values():
        yield "3-D view from elsewhere", view.click, soon
    microscope = op.panels["microscope"]
    yield "panel microscope", bring_up("microscope"), lambda: bench.microscope.status.cameras
    camera = partial(bench.microscope.camera.open, "simulated:microscope")
    yield "camera", camera, lambda: microscope.view.frame is not None
    yield "jog before the camera", partial(bench.jog, "x", 1e-4), lambda: op.rests
    yield "panel plate", bring_up("plate"), soon
    yield "solve the plate", plate.solve, lambda: plate.solved is not None
    for choice in plate.findChildren(QComboBox):
        yield "plate, choices", lambda one=choice: one.setCurrentIndex(one.count() - 1), soon


def devices(op):
    window, bench = op.window, op.bench
    calibration, compensation = op.panels["calibration"], op.panels["compensation"]
    penetration, faults = op.panels["penetration"], op.panels["faults"]
    idle = lambda: not compensation.job.running  # noqa: E731 (awaited)
    yield "panel penetration", partial(window.bring_up, "penetration"), soon
    yield "prepare a penetration", penetration.prepare, lambda: op.rests
    yield "panel calibration", partial(window.bring_up, "calibration"), soon
    yield "plan a calibration", calibration.plan, lambda: op.rests
    yield "panel compensation", partial(window.bring_up, "compensation"), soon
    yield "learn inverses", compensation.learn_simulated, idle
    yield "tune gains", compensation.tune, idle
    worn = partial(bench.session.service.set_effects, worn_effects(bench.robot))
    yield "effects", partial(window.bring_up, "effects"), soon
    yield "wear the machine", worn, lambda: op.rests
    board, device = faults.injection.board, op.panels["connection"].device
    yield "virtual boards", partial(board.start, 2, homed=True), lambda: bool(board.ports)
    chosen = device.choice.findText("mc68hc11")
    yield "choose a driver", partial(device.choice.setCurrentIndex, chosen), soon
    boards = partial(op.is_on, "mc68hc11")
    yield "connect to boards", nothing, device.connect_button.isEnabled
    yield "connect to boards", device.connect_button.click, boards
    simulator = partial(bench.use_driver, Simulator, {})
    yield "connect to the simulator", simulator, partial(op.is_on, "simulator")
    yield "end of the boards", board.end, lambda: op.rests


def quit_dialog(op):
    """Ask whether to quit while something moves, and stay."""
    session = op.bench.session
    jog = partial(op.bench.jog, "x", 5e-3)
    yield "a long move", jog, lambda: session.snapshot().activity is not DeviceState.IDLE

    def close():
        QTimer.singleShot(400, lambda: QApplication.activeModalWidget().reject())
        op.window.close()

    yield "quit dialog", close, soon


def _all(*parts):
    return lambda op: chain.from_iterable(part(op) for part in (start, *parts, themes))


PARTS = {
    "window": _all(layouts, panels, windows, messages),
    "work": _all(playback, diagnosis, records),
    "devices": _all(views, devices, quit_dialog),
}
