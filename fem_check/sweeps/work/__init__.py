"""Who answers the scenes of a sweep: this process, or workers."""
