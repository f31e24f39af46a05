"""The plane; knows no robot."""
