"""The robot side: a brain's contract, runner, world model, skills, the teams that ship. Knows no simulator."""
