"""What a match knows of the game that it plays; `sim_host.games` is the table of games."""
