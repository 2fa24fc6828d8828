"""What happens in a scene, by the names that drills use, and the verdict that follows from it."""
