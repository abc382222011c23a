"""What a person's recording is: its container, length and peaks, from its own bytes."""
