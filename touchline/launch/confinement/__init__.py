"""What a robot's process may see and use of the machine."""
