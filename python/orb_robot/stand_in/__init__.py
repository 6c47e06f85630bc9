"""Packages that a program started by `orb_robot run` imports instead of those that talk to real robots."""
