"""How people and coach programs take part in a match. Knows the bus, and nothing of physics, teams or files."""
