"""A series: many matches in processes of this machine, from a plan to a table of figures with intervals."""
