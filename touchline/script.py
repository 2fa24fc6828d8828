"""The script `touchline`, as it is installed: every robot that is forked imports it again, so it loads nothing else."""


def main() -> None:
    """Run the command line; exits with its status."""
    from touchline.__main__ import main as run_command_line

    run_command_line()
