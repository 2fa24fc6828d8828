"""Recording → MCAP with typed messages: protobuf made from the same models as the JSON, for tools that want columns."""
