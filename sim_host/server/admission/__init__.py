"""Who may do what at this host: claims of robots, presence, the limits of accounts, refusals."""
