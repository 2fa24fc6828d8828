"""Pictures of a match from above, by matplotlib: for environments of learners, recordings and documents."""
