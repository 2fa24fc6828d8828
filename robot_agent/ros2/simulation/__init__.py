"""The services of simulation_interfaces: nodes pause, step and change a match, with the rights of its operator."""
