"""A postprocessor's view of a job: the parameters that the CAM system would hand over, and the lines of the program that take them.

    python3 table.py job.json [touchpath]

The job is planned by the command (npx touchpath, or the one that is named), which gives the whole plan as JSON: the keys are those of Plan in
touchpath/answers.schema.json, and touchpath_types.py has them as types (Python 3.11).
"""

import json
import subprocess
import sys

from touchpath_types import Plan


def plan(job: str, command: list[str]) -> Plan:
    """The plan of a job's file. Where the job has errors, they are said as the command says them."""
    done = subprocess.run([*command, "plan", job, "--json"], capture_output=True, text=True)
    if done.returncode == 0:
        made: Plan = json.loads(done.stdout)
        return made
    if done.returncode == 2:
        raise SystemExit(done.stderr.strip())
    for finding in json.loads(done.stderr)["findings"]:
        if finding["level"] == "error":
            print(f"{job}:{finding.get('line', 1)}: {finding['path']}: {finding['message']}", file=sys.stderr)
    raise SystemExit(1)


def main() -> None:
    job, *command = sys.argv[1:]
    made = plan(job, command or ["npx", "--no-install", "touchpath"])
    for row in made["table"]:
        print(f"{row['code']:<22} {row['value']!s:<14} {row['meaning']}")
    program = made["program"]
    lines = program["text"].splitlines()
    print(f"\n{program['post']}: {len(lines)} lines, {program['does']}")
    for move, line in zip(made["moves"], program["moveLines"]):
        touch = move["touch"]
        if move["kind"] == "touch" and touch is not None and line >= 0:
            print(f"touch {touch + 1}: line {line + 1}: {lines[line]}")


if __name__ == "__main__":
    main()
