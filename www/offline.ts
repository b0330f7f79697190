// The page without a network: a service worker that keeps its files, and says when there are newer ones.

/** Keeps the page's files in this browser. When a newer version has been loaded, calls `ready` with a function that switches to it. */
export async function keepOffline(
  ready: (take: () => void) => void,
): Promise<void> {
  if (!("serviceWorker" in navigator)) return;
  // A newer version that the user has taken: this page is still of the old one.
  let taken = false;
  navigator.serviceWorker.addEventListener(
    "controllerchange",
    () => taken && location.reload(),
  );
  const offer = (worker: ServiceWorker) =>
    ready(() => {
      taken = true;
      worker.postMessage("take-over");
    });
  try {
    const registration = await navigator.serviceWorker.register(
      script("./sw.js"),
    );
    if (registration.waiting) offer(registration.waiting);
    registration.addEventListener("updatefound", () => {
      const { installing } = registration;
      installing?.addEventListener("statechange", () => {
        // The first one has no older page beside it.
        if (
          installing.state === "installed" &&
          navigator.serviceWorker.controller
        )
          offer(installing);
      });
    });
  } catch {
    // Not served securely, or not allowed: the page works, but not without a network.
  }
}

/** Has the worker keep a file that not every user wants, such as the words of a language: the page that was opened first has loaded it without the worker. */
export async function keep(file: string): Promise<void> {
  const registration = await navigator.serviceWorker?.ready;
  registration?.active?.postMessage({ keep: file });
}

type Policy = { createScriptURL(url: string): unknown };
/** The page's policy for addresses of scripts: made once, since its name is taken then. */
let policy: Policy | undefined;

/** The address of one of the page's own workers, as the page's policy asks for it. Throws where a stricter policy around forbids that. */
export function script(url: string): string {
  const types = (
    globalThis as {
      trustedTypes?: { createPolicy(name: string, rules: object): Policy };
    }
  ).trustedTypes;
  if (!types) return url;
  policy ??= types.createPolicy("touchpath", {
    createScriptURL(given: string): string {
      if (new URL(given, location.href).origin !== location.origin)
        throw new TypeError("not this page's script");
      return given;
    },
  });
  return policy.createScriptURL(url) as string;
}
