"""Growth in plane stress by linear finite elements, for any outline."""

from fem_check.plane_stress.field import PlaneStressField, plane_stress_field

__all__ = ["PlaneStressField", "plane_stress_field"]
