"""Plugins by others: written from templates, listed, checked, and left out when they fail."""
