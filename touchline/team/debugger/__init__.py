"""A brain in this process, in place of a robot of a recorded match: compared, stepped through, gone on with."""
