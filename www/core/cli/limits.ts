// What bounds a service: beside it, so that the command's help does not load it.
/** What a service may be asked for, and how long it waits. */
export interface Limits {
  /** Bytes of a body. */
  body: number;
  /** Requests at once. */
  requests: number;
  connections: number;
  /** Milliseconds for a request to come, for an answer, and for what is under way when the service ends. */
  wait: number;
}
export const LIMITS: Limits = {
  body: 2_000_000,
  requests: 64,
  connections: 1024,
  wait: 10_000,
};
