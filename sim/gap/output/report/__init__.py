"""The diagnosis as a web page.

A browser shows it without a network.
"""
