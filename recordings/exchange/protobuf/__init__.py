"""Recording → MCAP with typed messages: protobuf generated from the same models as the JSON."""
