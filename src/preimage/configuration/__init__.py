"""Configuration space: obstacles, contact space, regions."""
