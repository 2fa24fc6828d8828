"""The MCAP library's writer with the settings that all files of this project use."""

from typing import IO

from mcap.writer import CompressionType, Writer

CHUNK_BYTES = 256 * 1024
"""Uncompressed size of a chunk, in bytes: large enough to compress well, small enough for the cache."""


def mcap_writer(file: IO[bytes]) -> Writer:
    """A writer of zstd chunks with all indexes and all checksums."""
    return Writer(file, chunk_size=CHUNK_BYTES, compression=CompressionType.ZSTD, enable_data_crcs=True)
