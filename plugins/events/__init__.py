"""The operator's log: moves, stops, refusals.

It also lists locks and runs.
"""
