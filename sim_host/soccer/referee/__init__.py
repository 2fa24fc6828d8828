"""The referee: a pure core without network, wall clock, screen or physics engine."""
