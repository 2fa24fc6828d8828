"""The installed script `touchline`. Every forked robot imports it again, so it imports no other module."""


def main() -> None:
    """Run the command line; exits with its status."""
    from touchline.__main__ import main as run_command_line

    run_command_line()
