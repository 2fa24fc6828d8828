"""The pages of a cup: a folder that opens from disk, without a network and without scripts of its own."""
