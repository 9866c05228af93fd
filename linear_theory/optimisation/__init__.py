"""The best point of a region: kept optimisers from several starts, and a certificate of the result.

Numbers only: what they stand for in a scene is the matter of `fem_check.optimisation`.
"""
