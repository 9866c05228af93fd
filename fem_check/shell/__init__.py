"""The nonlinear sheet: a Koiter shell on scikit-fem elements, of the effects that a scene names."""
