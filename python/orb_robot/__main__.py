"""`python -m orb_robot`: see `--help`."""

from .running import main

if __name__ == "__main__":
    main()
