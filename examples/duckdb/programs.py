"""Programs for a table of features, by DuckDB and the command, part by part: the memory does not grow with the table.

    python3 programs.py features.parquet programs [touchpath ...] --parts 16

The table has a row a bore: `name`, `x`, `y`, `diameter`, `depth` (mm) and `post`. Each part is a file of its own, `part-0003-of-0016.parquet`, with the
number of each row in the table (from 0), its name, program and findings. A row is known by its number: names may be missing, or occur twice. A part that is there is not made again: give another table, or another version, a folder of its own. Several
machines may make parts of one table: --only 3,7,11.
"""

import argparse
import os
import subprocess
import tempfile

import duckdb

# A job a line: the columns are the keys of a job. The order is that of the table, so that a part is the same whenever it is made.
JOBS = """
COPY (
    SELECT 1 AS format, coalesce(name, 'ROW_' || file_row_number) AS name, {'post': post} AS control,
           {'type': 'hole', 'origin': [x, y, 0], 'diameter': diameter, 'depth': depth} AS cycle
    FROM read_parquet($table, file_row_number = true) WHERE file_row_number %% $parts = $part ORDER BY file_row_number
) TO %s (FORMAT json)
"""
# The command answers in the order of its lines: their places give the numbers of the rows.
OUTCOMES = """
COPY (
    SELECT (place - 1) * $parts + $part AS row, (line->>'name') AS name, program, findings
    FROM (SELECT *, row_number() OVER () AS place FROM read_json(%s, columns = {'program': 'VARCHAR', 'findings': 'JSON'}))
    JOIN (SELECT json AS line, row_number() OVER () AS place FROM read_ndjson_objects(%s)) USING (place)
    ORDER BY place
) TO %s (FORMAT parquet, COMPRESSION zstd)
"""


# Rows of the table in this part, and rows that were made.
COUNTS = """
SELECT (SELECT count(*) FROM read_parquet($table, file_row_number = true) WHERE file_row_number %% $parts = $part),
       (SELECT count(*) FROM read_parquet(%s))
"""


def quoted(path: str) -> str:
    return "'" + path.replace("'", "''") + "'"


def make(table: str, out: str, part: int, parts: int, command: list[str]) -> None:
    """Makes one part: it is there as a whole, or not at all."""
    target = os.path.join(out, f"part-{part:04}-of-{parts:04}.parquet")
    if os.path.exists(target):
        return
    with tempfile.TemporaryDirectory(dir=out) as folder:
        jobs, outcomes, made = (os.path.join(folder, name) for name in ("jobs.ndjson", "outcomes.ndjson", "made.parquet"))
        # One thread keeps the order of the lines.
        database = duckdb.connect(config={"threads": 1})
        of = {"table": table, "parts": parts, "part": part}
        database.execute(JOBS % quoted(jobs), of)
        with open(jobs) as given, open(outcomes, "w") as answered:
            done = subprocess.run([*command, "plan", "-", "--ndjson"], stdin=given, stdout=answered)
        # 1: a job has errors, which its line says.
        if done.returncode not in (0, 1):
            raise SystemExit(done.returncode)
        database.execute(OUTCOMES % (quoted(outcomes), quoted(jobs), quoted(made)), {"parts": parts, "part": part})
        wanted, found = database.execute(COUNTS % quoted(made), of).fetchone()
        if wanted != found:
            raise SystemExit(f"part {part}: {found} of {wanted} rows have an outcome")
        os.rename(made, target)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("table")
    parser.add_argument("out")
    parser.add_argument("--parts", type=int, default=16)
    parser.add_argument("--only", help="these parts alone, as 0,4,8")
    parser.add_argument("command", nargs="*", default=["npx", "--no-install", "touchpath"])
    given = parser.parse_args()
    os.makedirs(given.out, exist_ok=True)
    wanted = [int(part) for part in given.only.split(",")] if given.only else range(given.parts)
    for part in wanted:
        make(given.table, given.out, part, given.parts, given.command)
        print(f"part {part + 1} of {given.parts}", flush=True)


if __name__ == "__main__":
    main()
