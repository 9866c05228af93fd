"""Examples: each asks a question and computes, prints and draws the answer.

python -m figures.examples.first_speed
"""
