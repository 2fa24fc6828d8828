"""What every process needs: clocks, settings, log, whole files, scheduling, and an end with its launcher."""
