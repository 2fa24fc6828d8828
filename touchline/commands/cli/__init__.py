"""Shared parts of the commands: option groups, errors, the console, terminal keys, a bus client."""
