"""The game of robots on hardware without a host: what people and a league's box decide, and nothing measured."""
