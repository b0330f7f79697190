// Language server for programs that probe: the same verdicts as `touchpath examine`, while a program is edited.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import {
  createConnection,
  DiagnosticSeverity,
  DidChangeConfigurationNotification,
  ProposedFeatures,
  TextDocumentSyncKind,
  TextDocuments,
} from "vscode-languageserver/node";
import { TextDocument } from "vscode-languageserver-textdocument";
import {
  catalog,
  init,
  type ProgramKnown,
  type ProgramRun,
  runProgram,
} from "../core/init.js";
import { PROGRAM_POSTS } from "../core/program-posts.js";
import { notesOf, wordsOf } from "./notes.js";

init(readFileSync(join(__dirname, "touchpath.wasm")));

const SEVERITY = {
  error: DiagnosticSeverity.Error,
  warning: DiagnosticSeverity.Warning,
  info: DiagnosticSeverity.Information,
} as const;

/** Milliseconds without a change before a program is run again. */
const PAUSE = 250;

const connection = createConnection(ProposedFeatures.all);
const documents = new TextDocuments(TextDocument);
/** The last run of each document, by its address. */
const runs = new Map<string, { version: number; run: ProgramRun }>();
const timers = new Map<string, NodeJS.Timeout>();
let known: ProgramKnown = {};
let asksSettings = false;

connection.onInitialize(({ capabilities }) => {
  asksSettings = capabilities.workspace?.configuration === true;
  return {
    capabilities: {
      textDocumentSync: TextDocumentSyncKind.Incremental,
      hoverProvider: true,
    },
  };
});

connection.onInitialized(async () => {
  if (asksSettings)
    await connection.client.register(DidChangeConfigurationNotification.type);
  await configure();
});

connection.onDidChangeConfiguration(configure);

/** Reads the settings and examines every document again. */
async function configure(): Promise<void> {
  const settings = asksSettings
    ? await connection.workspace.getConfiguration("touchpath")
    : null;
  const post = PROGRAM_POSTS.find((one) => one === settings?.control);
  known = post === undefined ? {} : { post };
  runs.clear();
  for (const document of documents.all()) examine(document);
}

/** The run of a document; `null` if it is too long. */
function runOf(document: TextDocument): ProgramRun | null {
  const { uri, version } = document;
  const last = runs.get(uri);
  if (last?.version === version) return last.run;
  const text = document.getText();
  if (text.length > catalog().longestProgram) return null;
  const run = runProgram(text, known);
  runs.set(uri, { version, run });
  return run;
}

function examine(document: TextDocument): void {
  const run = runOf(document);
  const lines = document.lineCount;
  const diagnostics = (run ? notesOf(run) : []).map(
    ({ line, level, code, message }) => {
      const at = Math.min(line, lines - 1);
      return {
        range: {
          start: { line: at, character: 0 },
          end: { line: at, character: Number.MAX_SAFE_INTEGER },
        },
        severity: SEVERITY[level],
        source: "touchpath",
        code,
        message,
      };
    },
  );
  void connection.sendDiagnostics({
    uri: document.uri,
    version: document.version,
    diagnostics,
  });
}

documents.onDidChangeContent(({ document }) => {
  clearTimeout(timers.get(document.uri));
  timers.set(
    document.uri,
    setTimeout(() => examine(document), PAUSE),
  );
});

documents.onDidClose(({ document: { uri } }) => {
  clearTimeout(timers.get(uri));
  timers.delete(uri);
  runs.delete(uri);
  void connection.sendDiagnostics({ uri, diagnostics: [] });
});

connection.onHover(({ textDocument, position: { line } }) => {
  const document = documents.get(textDocument.uri);
  const run = document ? runOf(document) : null;
  if (!document || !run) return null;
  const text = document.getText({
    start: { line, character: 0 },
    end: { line: line + 1, character: 0 },
  });
  const value = wordsOf(run, line, text);
  return value === null ? null : { contents: { kind: "markdown", value } };
});

documents.listen(connection);
connection.listen();
