"""Any task as a Gymnasium environment, so that learners and solvers meet the same nature."""
