"""The sensors of the table: one file a kind, which computes its readings from a snapshot and random numbers."""
