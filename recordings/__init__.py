"""Everything that happened, in files: recorder, reader, facts of a recording. Knows the bus and MCAP, no physics."""
