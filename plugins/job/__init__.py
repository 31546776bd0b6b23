"""What runs now, how far it is, and how to pause or stop it."""
