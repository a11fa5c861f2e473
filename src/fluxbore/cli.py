"""The command line."""

import sys


def main(argv: list[str] | None = None) -> int:
    """Run one command and return its exit code."""
    arguments = sys.argv[1:] if argv is None else argv
    if arguments == ["doctor"]:
        from fluxbore.doctor import diagnose, report

        print(report(diagnose()))
        return 0
    print("usage: fluxbore doctor")
    return 2
