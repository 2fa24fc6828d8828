"""What the host says: state, events, health and orders, and what recorders get."""
