"""What every brain builds on, whatever the task: the contract, bodies, a world model, skills of motion."""
