"""One robot's process: the claim of its robot, the loop from sight to command, programs in other languages."""
