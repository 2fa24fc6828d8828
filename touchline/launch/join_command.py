"""The commands by which the remote teams of a match join it, for the people at the other machine."""

from pathlib import Path

from runtime.access.accounts import Account
from runtime.access.credentials import account_file
from runtime.bus.endpoint import is_loopback, parse_endpoint
from schemas.config.match_config import MatchConfig
from touchline.launch.own_address import endpoint_for_others


def join_lines(config: MatchConfig, listen: str | None, endpoint: str, credentials: Path | None) -> list[str]:
    """One line for each remote team; none without one.

    `listen` is where the host was told to listen, and `endpoint` where this machine reaches it. `credentials` is the
    folder of the match's credentials; None for a match that admits everybody.
    """
    if not config.remote_sides:
        return []
    _, _, port = parse_endpoint(endpoint)
    reached = endpoint
    if listen is not None and not is_loopback(listen):
        protocol, host, _ = parse_endpoint(listen)
        reached = endpoint_for_others(f"{protocol}/[{host}]:{port}" if ":" in host else f"{protocol}/{host}:{port}")
    lines = []
    for side in config.remote_sides:
        command = f"{side} joins with: touchline team {side} --connect {reached}"
        file = account_file(credentials, Account.of_team(side)) if credentials is not None else None
        lines.append(f"{command}{f' --credentials {file.name}' if file is not None else ''} --brain MODULE:CLASS")
        if file is not None:
            lines.append(f"  give it its credentials, and no other file: {file}")
    if is_loopback(reached):
        lines.append("  from this machine only, because the host listens on loopback; --listen tcp/[::]:7447 opens it")
    return lines
