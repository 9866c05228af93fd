"""Results: the speed of a sheet, its errors and range of validity, and the path of the sheet."""
