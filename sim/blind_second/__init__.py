"""A second generator of blind cases, with none of the first one's equations."""
