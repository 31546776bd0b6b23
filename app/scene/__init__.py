"""The robot as a scene in three dimensions, and the server that shows it to a browser."""
