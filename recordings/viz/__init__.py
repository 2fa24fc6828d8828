"""What viewers draw: a match as messages of `foxglove.*`, derived from what the host says, and from nothing else."""
