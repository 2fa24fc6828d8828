"""An experiment: factors over a match file, the same seeds in each cell, and what the figures can and cannot show."""
