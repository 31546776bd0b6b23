"""Third-party plugins: created from templates, listed, checked, and left out when they fail."""
