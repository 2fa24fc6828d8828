"""Robots in any language without Zenoh: a program that reads sights as lines of JSON and writes a command for each."""
