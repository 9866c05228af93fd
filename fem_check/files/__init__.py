"""Scene files: scenes as text in TOML, with units, to be edited by people and read by programs.

fields, tables, bodies   what can be said, by table and key     quantities, system   units
reading, mistakes        from text to tables                    parts/               to a Scene
writing, toml            from a Scene to text                   gallery              examples
"""

import lazy_loader

# Each name is imported when it is first used: the list of scenes to start from needs none of the rest.
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
