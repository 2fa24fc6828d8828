"""What a match is made of, read from files: match, roster, scene, profile, rule book. Frozen, with units and ranges."""
