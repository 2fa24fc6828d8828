"""Plans, launches, supervises and ends the processes of a match, and collects its result."""
