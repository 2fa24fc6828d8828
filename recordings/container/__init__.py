"""The file: MCAP records, manifest, attachments, schemas, partial and numbered files. Independent of the bus."""
