"""Published numbers, each with its source, and exact solutions."""
