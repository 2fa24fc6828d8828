"""The open pages: what they are sent, and what they request."""
