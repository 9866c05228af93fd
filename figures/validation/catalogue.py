"""All comparisons, grouped by subject."""

from collections.abc import Mapping
from types import ModuleType

from figures.validation import crawlers, excitable, ground, growing, plane_stress, plates, shells
from figures.validation.comparison import Comparison

MODULES: Mapping[str, ModuleType] = {
    "Crawlers in one dimension": crawlers,
    "Sheets on the ground": ground,
    "Growing sheets": growing,
    "Excitable waves": excitable,
    "Large deflections of shells": shells,
    "Plates": plates,
    "Plane stress": plane_stress,
}
"""Where the comparisons of a subject stand."""

SUBJECTS: Mapping[str, tuple[Comparison, ...]] = {
    subject: module.COMPARISONS for subject, module in MODULES.items()
}
"""Headings of the page and what stands under them."""

COMPARISONS: Mapping[str, Comparison] = {
    comparison.name: comparison for group in SUBJECTS.values() for comparison in group
}
"""By name."""
