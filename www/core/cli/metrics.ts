// Counters of the service in the format of Prometheus.

/** Upper bounds of the response time histogram, seconds. */
const ENDS = [0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1, 2.5, 5, 10];

interface Times {
  /** Number of requests up to each bound. */
  within: number[];
  sum: number;
  count: number;
}

export class Metrics {
  private readonly requests = new Map<string, number>();
  private readonly times = new Map<string, Times>();

  /** Counts an answered request. Unknown routes share one name, so a client cannot add names. */
  count(route: string, status: number, seconds: number): void {
    const path = route === "*" || route === "/*" ? "other" : route;
    const key = `route="${path}",status="${status}"`;
    this.requests.set(key, (this.requests.get(key) ?? 0) + 1);
    const own = this.times.get(path) ?? {
      within: ENDS.map(() => 0),
      sum: 0,
      count: 0,
    };
    for (const [i, end] of ENDS.entries())
      if (seconds <= end) own.within[i] = (own.within[i] ?? 0) + 1;
    own.sum += seconds;
    own.count++;
    this.times.set(path, own);
  }

  text(underWay: number, threads: number): string {
    const lines = [
      "# HELP touchpath_requests_total Requests that were answered.",
      "# TYPE touchpath_requests_total counter",
      ...[...this.requests].map(
        ([labels, count]) => `touchpath_requests_total{${labels}} ${count}`,
      ),
      "# HELP touchpath_request_seconds From the start of a request to its answer.",
      "# TYPE touchpath_request_seconds histogram",
    ];
    for (const [path, { within, sum, count }] of this.times) {
      const of = `route="${path}"`;
      for (const [i, end] of ENDS.entries())
        lines.push(
          `touchpath_request_seconds_bucket{${of},le="${end}"} ${within[i]}`,
        );
      lines.push(
        `touchpath_request_seconds_bucket{${of},le="+Inf"} ${count}`,
        `touchpath_request_seconds_sum{${of}} ${sum.toFixed(6)}`,
        `touchpath_request_seconds_count{${of}} ${count}`,
      );
    }
    const gauge = (name: string, about: string, value: number) =>
      lines.push(
        `# HELP ${name} ${about}`,
        `# TYPE ${name} gauge`,
        `${name} ${value}`,
      );
    gauge(
      "touchpath_requests_under_way",
      "Requests that are worked on.",
      underWay,
    );
    gauge("touchpath_threads", "Threads that work on requests.", threads);
    gauge(
      "process_resident_memory_bytes",
      "Memory of the process.",
      process.memoryUsage.rss(),
    );
    return `${lines.join("\n")}\n`;
  }
}
