"""The Airy-stress series of a rectangular sheet."""

from linear_theory.deformation.airy.series import (
    AiryAmplitudes,
    AirySeries,
    airy_series,
    balanced_modes,
)

__all__ = ["AiryAmplitudes", "AirySeries", "airy_series", "balanced_modes"]
