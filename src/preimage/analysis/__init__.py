"""How much error there may be, and why there is no more: budgets, maps, explanations."""
