"""The plate on its ground: deflection of first order in the curvature coupling, and what it does in
the plane."""

from linear_theory.deformation.plate.field import PlateField, plate_field
from linear_theory.deformation.plate.foundation import Foundation, foundation

__all__ = ["Foundation", "PlateField", "foundation", "plate_field"]
