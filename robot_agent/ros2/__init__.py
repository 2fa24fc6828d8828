"""Robots that ROS 2 nodes drive, in lockstep or in real time; and a match or a replay as a ROS 2 graph."""
