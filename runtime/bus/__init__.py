"""The typed bus: one contract, one implementation over Zenoh, one within a process."""
