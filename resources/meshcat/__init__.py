"""The viewer of meshcat 0.3.2.

The files are unchanged, with the licences of meshcat and of the libraries in it.
"""
