"""Shared by all processes: the bus, who may do what on it, clocks, settings and logs of a process."""
