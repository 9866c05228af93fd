"""Energy of a crawling sheet: work of growth, friction, cost of transport, efficiency."""
