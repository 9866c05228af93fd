"""The nonlinear sheet: a Koiter shell on scikit-fem elements, with the effects named by a scene."""
