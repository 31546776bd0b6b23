"""The gap between model and machine: where it lies, which effects cause it, how far it shrinks."""
