"""The web server: its ports, its files, and the WebSocket of a page."""
