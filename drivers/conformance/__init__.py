"""Whether a driver keeps the contract: behaviour tests that any driver can be put to."""
