"""The processes of a match: planned, launched, supervised and ended, and the result they leave."""
