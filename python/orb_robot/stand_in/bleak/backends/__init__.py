"""What Bleak keeps beside its two classes."""
