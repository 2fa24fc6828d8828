"""Where people and coach programs come in. Knows the bus; nothing of physics, teams or files."""
