"""Cases: particles, fields and what is known exactly about them."""
