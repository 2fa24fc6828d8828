"""Soccer on the host: the referee, and the ball with the robots that handle it."""
