"""Configuration of a match, read from files: match, roster, scene, profile and rule book; frozen, with units."""
