"""Problems of sheets, shells and plates that others solved, as functions of the mesh."""
