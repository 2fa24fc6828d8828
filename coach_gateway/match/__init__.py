"""A match as people and programs follow it, and what they ask its host for. Knows the bus; no page, no box."""
