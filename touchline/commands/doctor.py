"""`touchline health --doctor`: what works between this machine and a host, what does not, and what to do."""

import typer

from runtime.bus.settings import ClientSettings
from runtime.process.clock import WallClock
from touchline.commands.cli.errors import FAILED
from touchline.launch.terminal.json_text import json_text


def examine_and_print(connection: ClientSettings, *, json: bool) -> int:
    """Examine this machine and the way to a host; returns the exit status, which tells whether a line failed."""
    from touchline.commands.diagnosis.doctor.examination import examine
    from touchline.commands.diagnosis.doctor.finding import Status
    from touchline.commands.diagnosis.doctor.machine import MachineFacts

    findings = []
    for finding in examine(connection, WallClock(), MachineFacts.of_this_machine()):
        findings.append(finding)
        if not json:
            typer.echo(f"{finding.status.value:<8} {finding.name:<12} {finding.text}")
            if finding.remedy:
                typer.echo(f"{'':<21} → {finding.remedy}")
    failed = any(finding.status is Status.FAILED for finding in findings)
    if json:
        typer.echo(json_text({"ok": not failed, "findings": [finding._asdict() for finding in findings]}))
    return FAILED if failed else 0
