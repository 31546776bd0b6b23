"""The robot as a scene in three dimensions, its picture, and its server for browsers."""
