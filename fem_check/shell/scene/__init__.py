"""What is simulated by a shell."""
