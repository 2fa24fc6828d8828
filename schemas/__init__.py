"""Shared by all processes: configuration, messages, the topic table, the bus, and clocks."""
