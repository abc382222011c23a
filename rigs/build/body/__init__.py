"""The player's body: its shape, its joints, its skin weights, its skin and its eyes."""
