"""The levels that answer a question, and the choice between them."""
