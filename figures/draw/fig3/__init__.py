"""Figure 3: friction under a crawling sheet, and its mean speed by all the models."""
