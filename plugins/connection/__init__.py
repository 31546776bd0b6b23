"""The panel of the connection: driver, port, parameters, link quality, stop latency."""
