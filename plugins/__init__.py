"""The panels an operator sees, one folder a panel."""
