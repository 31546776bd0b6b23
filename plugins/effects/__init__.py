"""Effects of the running simulator.

Switch, tune, load and save them.
"""
