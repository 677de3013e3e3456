"""Calibration: the coefficients of the milling law from forces on a dynamometer (docs/calibration.md)."""
