"""Recordings of matches: recorder, readers, editing, statistics, pictures, replay, other formats. Uses no physics."""
