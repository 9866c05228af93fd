"""How a wave deforms the sheet at small growth: the field, by series or by Ritz, and second order."""
