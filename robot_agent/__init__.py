"""Robot agents: the contract of a brain, its runner, a world model, skills, the shipped teams. Knows no simulator."""
