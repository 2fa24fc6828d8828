"""For a team's authors: a new team's folder, its check, its robots step by step."""
