"""A stand-in for the package bluepy: its robots are virtual. All of it is in `btle`."""
