"""Policies: functions of a vector of numbers that a robot makes of its sight; a brain plays one in any match."""
