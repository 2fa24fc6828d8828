"""The messages on the bus, one module for each subject; the topic table maps keys to messages."""
