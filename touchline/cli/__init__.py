"""What the commands share: groups of options, errors, the console, keys of a terminal, a client of the bus."""
