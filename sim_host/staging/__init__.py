"""What an operator may do to the pitch between two ticks: pure decisions; the simulation carries them out."""
