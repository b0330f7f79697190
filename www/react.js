"use client";
import { createElement, useEffect, useLayoutEffect, useRef } from "react";

/** What the element takes as properties: React sets none on a custom element whose markup came from a server. */
const PROPERTIES = ["config", "job", "cycle", "post", "units", "theme", "readonly", "panels", "mode", "view", "measured", "storage", "links", "disabled", "name"];
const FLAGS = ["readonly", "links", "disabled"];
const EVENTS = ["job-change", "plan-change", "selection-change", "measured-change", "program-save", "finding"];
const isOwn = (key) => PROPERTIES.includes(key) || EVENTS.some((event) => key === `on${event}`);

/** On a server there is no layout, and React warns of the effect. */
const useClientLayoutEffect = typeof document === "undefined" ? useEffect : useLayoutEffect;

/** `<touch-path>` as a component: its properties and listeners hold after server rendering, too, and it loads the element by itself. */
export function TouchPath({ ref, ...props }) {
  const own = useRef(null);
  const now = useRef(props);
  const last = useRef({});
  useClientLayoutEffect(() => {
    now.current = props;
    for (const name of PROPERTIES)
      // What a render leaves out is as it was before it was ever set.
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
  // What the browser finds in the markup is not React's to compare.
  return createElement("touch-path", { ...rest, ref: put, suppressHydrationWarning: true });
}
