"""`python app` in a bare clone."""

from reparam.cli import main

if __name__ == "__main__":
    raise SystemExit(main())
