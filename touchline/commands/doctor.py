"""`touchline doctor`: what works between this machine and a host, what does not, and what to do."""

import json as json_text
from typing import TYPE_CHECKING

import typer

from schemas.bus.settings import ClientSettings
from touchline.cli import options
from touchline.cli.errors import FAILED
from touchline.cli.option_groups import with_option_groups

if TYPE_CHECKING:
    from touchline.doctor.finding import Finding


@with_option_groups
def doctor(
    json: options.Json = False,
    *,
    connection: ClientSettings,
) -> None:
    """Examine this machine and the way to a host: name, port, certificate, credentials, version, delay, clock, robots.

    Without --connect it examines this machine, and the match that runs on it. The exit status is 1 if a line failed.

    Example: touchline doctor --connect tcp/192.168.1.5:7447
    """
    from schemas.process.clock import WallClock
    from touchline.doctor.examination import examine
    from touchline.doctor.finding import Status
    from touchline.doctor.machine import MachineFacts

    findings = []
    for finding in examine(connection, WallClock(), MachineFacts.of_this_machine()):
        findings.append(finding)
        if not json:
            _print(finding)
    failed = any(finding.status is Status.FAILED for finding in findings)
    if json:
        content = {"ok": not failed, "findings": [finding._asdict() for finding in findings]}
        typer.echo(json_text.dumps(content, ensure_ascii=False))
    raise typer.Exit(FAILED if failed else 0)


def _print(finding: "Finding") -> None:
    typer.echo(f"{finding.status.value:<8} {finding.name:<12} {finding.text}")
    if finding.remedy:
        typer.echo(f"{'':<21} → {finding.remedy}")
