"use client";
import { createElement, useEffect, useLayoutEffect, useRef } from "react";

/** Properties of the element: React sets no properties on a custom element whose markup came from a server. */
const PROPERTIES = ["config", "job", "cycle", "post", "units", "theme", "readonly", "panels", "mode", "view", "measured", "storage", "links", "disabled", "name"];
const FLAGS = ["readonly", "links", "disabled"];
const EVENTS = ["job-change", "plan-change", "selection-change", "measured-change", "program-save", "finding"];
const isOwn = (key) => PROPERTIES.includes(key) || EVENTS.some((event) => key === `on${event}`);

/** A server has no layout, and React warns about the effect there. */
const useClientLayoutEffect = typeof document === "undefined" ? useEffect : useLayoutEffect;

/** `<touch-path>` as a component. Its properties and listeners also work after server rendering, and it loads the element automatically. */
export function TouchPath({ ref, ...props }) {
  const own = useRef(null);
  const now = useRef(props);
  const last = useRef({});
  useClientLayoutEffect(() => {
    now.current = props;
    for (const name of PROPERTIES)
      // A property that a render omits returns to its initial value.
      if (name in props ? !Object.is(props[name], last.current[name]) : name in last.current)
        own.current[name] = props[name] ?? (FLAGS.includes(name) ? false : null);
    last.current = Object.fromEntries(PROPERTIES.filter((name) => name in props).map((name) => [name, props[name]]));
  });
  useClientLayoutEffect(() => {
    const element = own.current;
    const heard = EVENTS.map((event) => [event, (said) => now.current[`on${event}`]?.(said)]);
    for (const [event, listener] of heard) element.addEventListener(event, listener);
    import("./element/element.js").catch((why) => console.error(why));
    return () => {
      for (const [event, listener] of heard) element.removeEventListener(event, listener);
    };
  }, []);
  const rest = Object.fromEntries(Object.entries(props).filter(([key]) => !isOwn(key)));
  const put = (element) => {
    own.current = element;
    if (typeof ref === "function") return ref(element);
    if (ref) ref.current = element;
  };
  // React must not compare the markup that the browser has parsed.
  return createElement("touch-path", { ...rest, ref: put, suppressHydrationWarning: true });
}
