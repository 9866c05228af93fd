"""The Legendre-Ritz solution of a rectangular sheet, for any wave."""

from linear_theory.deformation.ritz.field import RitzField, ritz_field

__all__ = ["RitzField", "ritz_field"]
