"""A second generator of blind cases, by equations that are none of the first one's."""
