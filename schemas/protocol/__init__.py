"""The page `docs/protocol.md`, made from the topic table, the messages, their examples, and a text on joining."""
