"""Exports recordings to other formats and imports logs; one module or package for each format."""
