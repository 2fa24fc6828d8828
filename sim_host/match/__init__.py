"""One match without a network: the simulation of a tick, and the subsystems that it is made of."""
