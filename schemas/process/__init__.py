"""What a process needs of its operating system: clocks, scheduling policy, and work in idle time."""
