"""The referee: a pure core that knows no network, no clock, no screen and no physics engine."""
