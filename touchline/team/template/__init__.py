"""The folder that `touchline new` makes: a team that plays, its match file, its test, and a README.

`team_name` and `TeamName` in these files are replaced by the name of the team.
"""
