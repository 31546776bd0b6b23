"""Conformance tests that check whether a driver keeps the contract."""
