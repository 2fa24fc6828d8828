"""The file: MCAP records, manifest, header, schemas, partial and numbered files. Knows no bus."""
