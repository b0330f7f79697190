// Completion scripts for shells, made from the command's own lists.
import { catalog } from "../node.js";
import { meant } from "./about.js";
import { CODES, RULES } from "./codes.js";
import { Refused } from "./folder.js";

/** Data for a shell: the description of each command, its options and formats, and the values of other options. */
export interface Completed {
  about: Record<string, string>;
  options: Record<string, string[]>;
  formats: Record<string, string[]>;
  values: Record<string, readonly string[]>;
}

const SHELLS = { bash, zsh, fish };

/** The script of a shell. */
export function completion(shell: string, completed: Completed): string {
  const names = Object.keys(SHELLS);
  if (!Object.hasOwn(SHELLS, shell))
    throw new Refused(
      `completion takes ${names.join(", ")}, not ${shell || "nothing"}${meant(shell, names)}`,
    );
  return SHELLS[shell as keyof typeof SHELLS](completed, {
    new: catalog().cycles.map(({ type }) => type),
    explain: [...Object.keys(CODES), ...Object.keys(RULES)].sort(),
    completion: names,
  });
}

type Behind = Record<string, readonly string[]>;

/** Words in order, separated by blanks: the shell splits them again. */
const joined = (words: readonly string[]) => `"${words.join(" ")}"`;

function bash(
  { about, options, formats, values }: Completed,
  behind: Behind,
): string {
  const after = [
    ...Object.entries(values).map(
      ([flag, words]): [string, readonly string[]] => [`*" ${flag}"`, words],
    ),
    ...Object.entries(formats).map(
      ([name, words]): [string, readonly string[]] => [
        `"${name} --format"`,
        words,
      ],
    ),
  ];
  const cases = (
    of: [string, readonly string[]][],
    then: (words: readonly string[]) => string,
  ) => of.map(([name, words]) => `    ${name}) ${then(words)} ;;`).join("\n");
  const list = (words: readonly string[]) => `words=${joined(words)}`;
  return `# touchpath completion bash > /etc/bash_completion.d/touchpath, or: source <(touchpath completion bash)
_touchpath() {
  local cur="\${COMP_WORDS[COMP_CWORD]}" prev="\${COMP_WORDS[COMP_CWORD-1]}" command="\${COMP_WORDS[1]}" words=""
  COMPREPLY=()
  case "$command $prev" in
${cases(after, list)}
  esac
  if [[ $COMP_CWORD -eq 1 ]]; then
    words=${joined([...Object.keys(about), "--help", "--version"])}
  elif [[ -z $words && $cur == -* ]]; then
    case "$command" in
${cases(Object.entries(options), list)}
    esac
  elif [[ -z $words ]]; then
    case "$command" in
${cases(Object.entries(behind), list)}
    esac
  fi
  # With nothing to offer, files are: the shell itself knows how to write their names.
  [[ -n $words ]] && COMPREPLY=($(compgen -W "$words" -- "$cur"))
}
complete -o default -F _touchpath touchpath
`;
}

function zsh(completed: Completed, behind: Behind): string {
  return `# touchpath completion zsh > a folder of $fpath/_touchpath, or: source <(touchpath completion zsh)
autoload -U +X bashcompinit && bashcompinit
${bash(completed, behind)
  .replace(/^#.*\n/, "")
  .replace("    compopt -o filenames 2>/dev/null\n", "")}`;
}

function fish(
  { about, options, formats, values }: Completed,
  behind: Behind,
): string {
  const quoted = (text: string) =>
    `'${text.replaceAll("\\", "\\\\").replaceAll("'", "\\'")}'`;
  const lines = [
    "# touchpath completion fish > ~/.config/fish/completions/touchpath.fish",
  ];
  for (const [name, says] of Object.entries(about))
    lines.push(
      `complete -c touchpath -n __fish_use_subcommand -f -a ${name} -d ${quoted(says)}`,
    );
  for (const [name, words] of Object.entries(behind))
    lines.push(
      `complete -c touchpath -n 'test (count (commandline -opc)) -eq 2; and __fish_seen_subcommand_from ${name}' -f -a ${joined(words)}`,
    );
  for (const [name, flags] of Object.entries(options))
    for (const flag of flags) {
      const long = flag.startsWith("--");
      const words = flag === "--format" ? formats[name] : values[flag];
      const takes = words ? ` -x -a ${joined(words)}` : "";
      lines.push(
        `complete -c touchpath -n '__fish_seen_subcommand_from ${name}' ${long ? "-l" : "-s"} ${flag.replace(/^-+/, "")}${takes}`,
      );
    }
  return `${lines.join("\n")}\n`;
}
