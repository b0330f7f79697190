// The extension: starts the language server beside the editor.
import { join } from "node:path";
import type { ExtensionContext } from "vscode";
import { LanguageClient, TransportKind } from "vscode-languageclient/node";

let client: LanguageClient | undefined;

/** Called by the editor when a program is opened. */
export async function activate(context: ExtensionContext): Promise<void> {
  const module = join(context.extensionPath, "server.js");
  const server = { module, transport: TransportKind.ipc };
  client = new LanguageClient(
    "touchpath",
    "Touchpath",
    { run: server, debug: server },
    {
      documentSelector: [
        { language: "probing-program" },
        { language: "gcode" },
      ],
    },
  );
  await client.start();
}

export async function deactivate(): Promise<void> {
  await client?.stop();
}
