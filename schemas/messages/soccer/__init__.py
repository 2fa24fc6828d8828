"""Messages of soccer: the game, the seat of the referee, and the formats of the league."""
