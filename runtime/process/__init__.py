"""Services of the operating system: clocks, scheduling policy, and work in idle time."""
