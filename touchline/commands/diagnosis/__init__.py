"""Why a match does not work as it should: machine, route and link, and the health of its robots."""
