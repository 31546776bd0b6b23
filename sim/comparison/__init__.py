"""How far the nominal model is from a record of the real machine."""
