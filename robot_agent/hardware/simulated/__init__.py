"""A robot that is a process, behind a serial line: the way to a motor controller is real, the body is not."""
