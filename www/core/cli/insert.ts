// The command `insert`: the program of a job inside another program.
import {
  type AnyJob,
  type Config,
  importJob,
  insertProgram,
  JobError,
} from "../node.js";
import { Refused } from "./folder.js";

/** What goes to the standard output and to the error output, and the exit code. */
interface Inserted {
  text: string;
  said: string;
  code: 0 | 1;
}

/** Inserts the program of a job, as JSON or in the header of a program, into another one. `line`: the line after which it goes, from 1. */
export function inserted(
  job: string,
  into: string,
  line: string | undefined,
  config: Config | undefined,
): Inserted {
  const number = line === undefined ? undefined : Number(line);
  if (number !== undefined && !(Number.isInteger(number) && number > 0))
    throw new Refused(`--line takes the number of a line, not ${line}`);
  try {
    const imported = importJob(job);
    if (imported.job === null)
      throw new Refused("insert takes a job first, then a program");
    const { text, first, count, findings } = insertProgram(
      imported.job as AnyJob,
      into,
      {
        ...(number === undefined ? {} : { line: number - 1 }),
        ...(config === undefined ? {} : { config }),
      },
    );
    const notes = findings.map(({ level, message }) => `${level}: ${message}`);
    const where = `The program is in lines ${first + 1} to ${first + count}`;
    return { text, said: [where, ...notes].join("\n"), code: 0 };
  } catch (thrown) {
    if (!(thrown instanceof JobError)) throw thrown;
    const errors = thrown.findings
      .filter(({ level }) => level === "error")
      .map(({ path, message }) => `error: ${path && `${path}: `}${message}`);
    return { text: "", said: errors.join("\n"), code: 1 };
  }
}
