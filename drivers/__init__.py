"""Driver contract and built-in drivers.

Free of Qt.
"""
