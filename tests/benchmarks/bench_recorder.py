"""What recording costs: 20 kHz × 24 channels in real time, compared with simple methods.

``make bench`` runs it. The recorder may take at most 10 % of a core, including thread and disk.
"""

import csv
import io
import os
import resource
import time
from collections.abc import Callable
from math import inf
from pathlib import Path

import numpy as np
import pyarrow as pa

from rotemina.app.motion.recording import Recording
from rotemina.app.motion.recording.writer import RecordingWriter
from rotemina.drivers.contract import DeviceSamples

RATE_HZ = 20_000
# Each axis has four channels.
AXES = 6
PORTION_S = 0.016
SECONDS, LONG_S = 15.0, 600.0
MAX_LOAD = 0.10
QUICK = {"SECONDS": 1.0, "LONG_S": 6.0, "MAX_LOAD": inf}


def make_portion(first: int) -> tuple[DeviceSamples, np.ndarray]:
    """Return a portion of noisy readings, rounded as by sensors."""
    count = round(PORTION_S * RATE_HZ)
    rng = np.random.default_rng(first)
    command = np.repeat(0.02 + 1e-6 * np.sin(np.arange(first, first + count) / 1e3)[:, None], 6, 1)
    measured = np.rint((command + 1e-8 * rng.standard_normal(command.shape)) / 1e-9) * 1e-9
    times = np.arange(first, first + count) / RATE_HZ
    samples = DeviceSamples(times, command, measured, command * 2e6, np.full(count, -1))
    return samples, command * 0.999


def measure_load(
    keep: Callable[[DeviceSamples, np.ndarray], None], end: Callable[[], None]
) -> float:
    """Add portions in real time; return the share of a core that is needed to store them."""
    # The portions are made in advance and reused, so that making them costs nothing.
    portions = [make_portion(320 * number) for number in range(64)]
    count = round(SECONDS / PORTION_S)
    span_s = len(portions) * PORTION_S
    began_s, before_s = time.perf_counter(), time.process_time()
    for number in range(count):
        samples, model = portions[number % len(portions)]
        repetition = number // len(portions)
        shifted = DeviceSamples(
            samples.device_time_s + repetition * span_s,
            samples.command,
            samples.measured,
            samples.inputs,
            samples.playback_row,
        )
        keep(shifted, model)
        time.sleep(max(0.0, began_s + (number + 1) * PORTION_S - time.perf_counter()))
    end()
    return (time.process_time() - before_s) / (time.perf_counter() - began_s)


def test_the_recorder_takes_a_small_part_of_a_core(tmp_path: Path) -> None:
    idle_load = measure_load(lambda *_: None, lambda: None)
    writer = RecordingWriter(tmp_path / "run.arrows", dict.fromkeys("abcdef", "m"), {})
    writer.start()
    recorder_load = measure_load(
        lambda samples, model: writer.add(samples, model, time.monotonic()), writer.run_once
    )
    part_bytes = writer.bytes_written
    began_s = time.perf_counter()
    path = writer.close()
    merging_s = time.perf_counter() - began_s
    rows = Recording.open(path).count
    assert rows == round(SECONDS / PORTION_S) * 320
    print(
        f"recorder: {100 * (recorder_load - idle_load):.1f} % of a core at {RATE_HZ / 1e3:g} kHz × "
        f"{4 * AXES} channels (transfer to it {100 * idle_load:.1f}), {part_bytes / rows:.0f} "
        "bytes per "
        f"sample; {SECONDS:g} s merged in {merging_s:.2f} s"
    )
    for name, keep, end in list_naive_methods(tmp_path):
        naive_load = measure_load(keep, end)
        print(f"{name}: {100 * (naive_load - idle_load):.1f} %")
    assert recorder_load - idle_load <= MAX_LOAD


def list_naive_methods(folder: Path):
    text = (folder / "run.csv").open("w", newline="")
    rows = csv.writer(text)

    def append_csv(samples: DeviceSamples, model: np.ndarray) -> None:
        rows.writerows(make_table(samples, model).tolist())
        text.flush()

    def save_block(samples: DeviceSamples, model: np.ndarray) -> None:
        path = folder / f"{samples.device_time_s[0]:.6f}.npy"
        with path.open("wb") as file:
            np.save(file, make_table(samples, model))
            file.flush()
            os.fsync(file.fileno())

    yield "csv.writer, a block at a time, no fsync", append_csv, text.close
    yield "numpy.save and fsync of each block", save_block, lambda: None


def make_table(samples: DeviceSamples, model: np.ndarray) -> np.ndarray:
    times = samples.device_time_s[:, None]
    return np.hstack([times, samples.command, samples.inputs, model, samples.measured])


def test_compression_is_not_worth_its_time() -> None:
    parts = [make_portion(320 * number) for number in range(32)]
    table = np.concatenate([make_table(*part) for part in parts])
    schema = pa.schema([(str(column), pa.float64()) for column in range(table.shape[1])])
    batch = pa.record_batch(
        [pa.array(np.ascontiguousarray(column)) for column in table.T], schema=schema
    )
    print("compression: bytes per sample, % of a core")
    for codec in (None, "lz4", "zstd"):
        options = pa.ipc.IpcWriteOptions(compression=codec, use_threads=False)
        began_s = time.process_time()
        for _ in range(50):
            sink = io.BytesIO()
            with pa.ipc.new_stream(sink, schema, options=options) as writer:
                writer.write_batch(batch)
        cpu_s = (time.process_time() - began_s) / 50 / (len(table) / RATE_HZ)
        size = len(sink.getvalue()) / len(table)
        print(f"{codec or 'none':4} {size:.0f} {100 * cpu_s:.2f}")


def test_long_recordings(tmp_path: Path) -> None:
    """Measure long recordings at 20 kHz, as fast as possible: size, memory, merging, opening."""
    writer = RecordingWriter(tmp_path / "run.arrows", dict.fromkeys("abcdef", "m"), {})
    samples, model = make_portion(0)
    peak_before_mb = measure_peak_mb()
    for number in range(round(LONG_S / PORTION_S)):
        shifted = DeviceSamples(
            samples.device_time_s + number * PORTION_S,
            samples.command,
            samples.measured,
            samples.inputs,
            samples.playback_row,
        )
        writer.add(shifted, model, number * PORTION_S)
        if number % 25 == 24:
            writer.run_once()
    writer.run_once()
    recording_mb = measure_peak_mb() - peak_before_mb
    size = writer.bytes_written
    began_s = time.perf_counter()
    writer.close()
    path = tmp_path / "run.arrows"
    merging_s = time.perf_counter() - began_s
    merging_mb = measure_peak_mb() - peak_before_mb
    began_s = time.perf_counter()
    recording = Recording.open(path)
    opening_s = time.perf_counter() - began_s
    began_s = time.perf_counter()
    assert 19_999 <= len(recording.read_samples(LONG_S / 2, LONG_S / 2 + 1.0)) <= 20_001
    second_s = time.perf_counter() - began_s
    print(
        f"{LONG_S:g} s: {size / 1e9:.2f} GB; memory grows by {recording_mb:.0f} MB, merging by "
        f"{merging_mb:.0f}; merged in {merging_s:.1f} s, opened in {1e3 * opening_s:.0f} ms, one "
        f"second read in {1e3 * second_s:.1f} ms"
    )


def measure_peak_mb() -> float:
    """Return the peak memory of this process, MB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e3
