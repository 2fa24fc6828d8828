"""The words that all processes share: configuration, messages and the topic table."""
