"""Languages of the window.

Qt reads one file for each; the folder also has what it is made from.
"""
