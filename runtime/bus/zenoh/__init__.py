"""The bus over Zenoh; no other package imports Zenoh."""
