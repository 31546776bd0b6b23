"""Cameras in use, one thread each.

All readers get the newest picture.
"""
