"""Diagnosis of the sim-to-real gap.

A diagnosis goes one way: ``intake`` checks records, ``noise`` and ``location`` describe the gap,
``fit`` and ``compare`` explain it, ``examination`` treats one axis, and ``pipeline`` draws the
conclusions. ``result`` holds the answer, and ``output`` writes it. Start a diagnosis with
``pipeline``.
"""
