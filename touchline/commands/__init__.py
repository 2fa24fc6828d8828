"""The commands of `touchline`, one a file; what is heavy is imported inside the command that needs it."""
