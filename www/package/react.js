"use client";
import { createElement, useEffect, useLayoutEffect, useRef } from "react";
import { EVENTS } from "./events.js";

/** A server has no layout, and React warns about the effect there. */
const useClientLayoutEffect = typeof document === "undefined" ? useEffect : useLayoutEffect;
const FLAGS = ["readonly", "links", "disabled"];

/** Names of an event's listener among the properties: `onJobChange`, and `onjob-change` as on the bare tag. */
const listeners = (event) => [`on${event}`, `on-${event}`.replace(/-(\w)/g, (_, letter) => letter.toUpperCase())];

/**
 * An element as a component. React sets neither properties nor listeners on a custom element whose markup came from a server: the component sets them.
 */
function component(tag, properties, events) {
  const own = [...properties, ...events.flatMap(listeners)];
  return function Touch({ ref, ...props }) {
    const held = useRef(null);
    const now = useRef(props);
    const last = useRef({});
    useClientLayoutEffect(() => {
      now.current = props;
      for (const name of properties)
        // A property that a render omits returns to its initial value.
        if (name in props ? !Object.is(props[name], last.current[name]) : name in last.current)
          held.current[name] = props[name] ?? (FLAGS.includes(name) ? false : null);
      last.current = Object.fromEntries(properties.filter((name) => name in props).map((name) => [name, props[name]]));
    });
    useClientLayoutEffect(() => {
      const element = held.current;
      const heard = events.map((event) => [
        event,
        (said) => {
          // Elements in its slots have events of the same names.
          if (said.target === element) for (const name of listeners(event)) now.current[name]?.(said);
        },
      ]);
      for (const [event, listener] of heard) element.addEventListener(event, listener);
      import("./element/element.js").catch((why) => console.error(why));
      return () => {
        for (const [event, listener] of heard) element.removeEventListener(event, listener);
      };
    }, []);
    const rest = Object.fromEntries(Object.entries(props).filter(([key]) => !own.includes(key)));
    const put = (element) => {
      held.current = element;
      if (typeof ref === "function") return ref(element);
      if (ref) ref.current = element;
    };
    // React must not compare the markup that the browser has parsed.
    return createElement(tag, { ...rest, ref: put, suppressHydrationWarning: true });
  };
}

/** `<touch-path>` as a component. It loads the element automatically. */
export const TouchPath = component(
  "touch-path",
  ["config", "job", "cycle", "post", "units", "theme", "readonly", "panels", "mode", "view", "measured", "storage", "history", "links", "disabled", "name"],
  [...EVENTS, "load", "error"],
);

const PART = ["session", "panels"];

/** `<touch-form>` as a component. */
export const TouchForm = component("touch-form", PART, []);

/** `<touch-picture>` as a component. */
export const TouchPicture = component("touch-picture", PART, []);

/** `<touch-program>` as a component. */
export const TouchProgram = component("touch-program", PART, []);
