"""Power and cost of transport: their errors on random sheets, and what gaits cost."""
