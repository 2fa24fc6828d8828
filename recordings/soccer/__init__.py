"""What recordings know of soccer: statistics, and the logs of the league."""
