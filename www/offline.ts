// The page without a network: a service worker stores its files and announces a newer version.

/** Keeps the page's files in this browser. When a newer version has been loaded, calls `ready` with a function that switches to it. */
export async function keepOffline(
  ready: (take: () => void) => void,
): Promise<void> {
  if (!("serviceWorker" in navigator)) return;
  // The user has switched to a newer version, but this page still runs the old one.
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
        // The first worker replaces no older page.
        if (
          installing.state === "installed" &&
          navigator.serviceWorker.controller
        )
          offer(installing);
      });
    });
  } catch {
    // The page is not served securely, or workers are not allowed: it works, but only with a network.
  }
}

/** Lets the worker store an optional file, such as the words of a language. The first page of an origin loads it before the worker exists. */
export async function keep(file: string): Promise<void> {
  const registration = await navigator.serviceWorker?.ready;
  registration?.active?.postMessage({ keep: file });
}

type Policy = { createScriptURL(url: string): unknown };
/** Trusted Types policy for script addresses. Created once, because its name cannot be used twice. */
let policy: Policy | undefined;

/** Address of one of the page's own workers, as the Trusted Types policy requires it. Throws if a stricter policy of the host page forbids it. */
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
