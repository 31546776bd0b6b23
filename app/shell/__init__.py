"""The window that hosts the panels (Qt)."""
