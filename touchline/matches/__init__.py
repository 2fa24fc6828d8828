"""Many matches: one engine that plays plans, and the kinds of plan: series, drill, study, cup."""
