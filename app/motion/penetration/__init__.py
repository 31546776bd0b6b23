"""Cell penetration, from approach to retraction."""
