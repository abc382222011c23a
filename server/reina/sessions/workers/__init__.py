"""Long pure-Python work in processes of its own."""
