"""The contract: messages, topics, field and rules as data, frames, the bus and the clock. Knows no process."""
