"""The match on the bus: pace, command intake, publishers, presence, services, manual control and health."""
