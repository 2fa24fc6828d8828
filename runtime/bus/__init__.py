"""The typed bus: one contract, one implementation over Zenoh; endpoints, and how a host is found."""
