"""A recording compared with what is computed again: the world tick by tick, or the commands of a brain."""
