"""What a match shows in a terminal: one panel of lines that is drawn again, and lines on a stream that is none."""
