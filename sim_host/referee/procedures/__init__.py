"""What follows from decisions and time: the restart sequence, periods, discipline, the shoot-out, the end."""
