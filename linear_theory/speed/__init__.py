"""Answers: the speed of a sheet, its errors and its reach, and the path of the sheet."""
