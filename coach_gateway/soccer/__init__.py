"""What the gateway knows of soccer: the league's referee box."""
