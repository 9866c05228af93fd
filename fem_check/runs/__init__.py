"""Scenes run to folders: the answer, the motion as arrays, pictures, a film and a page to look at.

running   a scene to its folder           capture, recording, netcdf   the motion without its solver
folder    names of the files, the lock    pictures, animation, report  what is drawn from it
"""

import lazy_loader

# Each name is imported when it is first used: reading a finished run needs no solver.
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
