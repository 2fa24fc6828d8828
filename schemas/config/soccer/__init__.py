"""Configuration of soccer: the rule book, drills, and how a kicked ball moves."""
