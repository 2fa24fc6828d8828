"""The procedures that follow from decisions and time: restarts, periods, discipline, the shoot-out, the end."""
