"""A ROS 2 graph over Zenoh, as rmw_zenoh has it, without an installation of ROS: names, types, publishers, services."""
