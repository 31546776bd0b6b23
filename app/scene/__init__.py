"""The robot as a 3-D scene.

It has the picture of the scene, and the server for browsers.
"""
