"""What the operating system gives: files written whole, child processes and what goes between them."""
