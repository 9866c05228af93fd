"""The best scene: what may change, what is to be large, and the search for it with its certificate.

over, unknowns   what may change          objectives   what is to be large
values, kept     answers and gradients    optimising   the search; result: what it found
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
