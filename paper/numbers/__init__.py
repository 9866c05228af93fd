"""The numbers that the text of the write-up names: computed here, printed there."""
