"""The ledger of a match: what became of every sight and command, live and recorded."""
