// Limits of the service, in a file of their own so that the help does not load the service.
/** Limits of requests, and how long the service waits. */
export interface Limits {
  /** Maximum size of a body, bytes. */
  body: number;
  /** Maximum number of parallel requests. */
  requests: number;
  connections: number;
  /** Milliseconds for a request to arrive, for an answer, and for pending work when the service ends. */
  wait: number;
}
export const LIMITS: Limits = {
  body: 2_000_000,
  requests: 64,
  connections: 1024,
  wait: 10_000,
};
