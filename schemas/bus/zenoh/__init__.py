"""The bus over Zenoh; nothing else imports Zenoh."""
