"""The confusion matrix as a picture."""

from collections.abc import Mapping
from typing import BinaryIO

import numpy as np


def draw_confusion(counts: Mapping[tuple[str, str], int], file: BinaryIO) -> None:
    """Draw as SVG how often each truth (rows) was named as what (columns), as shares of the row."""
    from matplotlib import rc_context
    from matplotlib.figure import Figure

    names = sorted({name for pair in counts for name in pair})
    table = np.array([[counts.get((truth, told), 0) for told in names] for truth in names])
    shares = table / np.maximum(table.sum(axis=1, keepdims=True), 1)
    size = max(4.0, 1.5 + 0.28 * len(names))
    with rc_context({"svg.hashsalt": "rotemina"}):
        figure = Figure(figsize=(size, size), layout="constrained")
        axes = figure.subplots()
        axes.imshow(shares, cmap="Blues", vmin=0.0, vmax=1.0)
        axes.set_xticks(range(len(names)), names, rotation=90, fontsize=7)
        axes.set_yticks(range(len(names)), names, fontsize=7)
        axes.set_xlabel("named first")
        axes.set_ylabel("what is there")
        for i, j in zip(*np.nonzero(table), strict=True):
            colour = "white" if shares[i, j] > 0.5 else "black"
            axes.text(j, i, str(table[i, j]), ha="center", va="center", fontsize=6, color=colour)
        figure.savefig(file, format="svg", metadata={"Date": None})
