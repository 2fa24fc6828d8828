"""Records a running match from the bus: receives, reorders, counts losses, and writes files."""
