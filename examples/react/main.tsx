// Rendered by the browser alone: React 19 sets the properties of the tag and listens to its events. For a tree that a server renders there is `TouchPath` of touchpath-element/react.
import { useState } from "react";
import { createRoot } from "react-dom/client";
import type { AnyJob } from "touchpath";
import "touchpath-element";
import type {} from "touchpath-element/react"; // the types of <touch-path>

function Probing() {
  const [job, setJob] = useState<AnyJob>({ format: 1, name: "FROM_REACT", cycle: { type: "hole", diameter: 30 } });
  const [lines, setLines] = useState<number | null>(0);
  // A user who adds a feature makes the job a set-up of several cycles.
  const cycle = job.format === 1 ? job.cycle : job.cycles[0];
  return (
    <>
      <p role="status">
        {job.name}: diameter {cycle?.type === "hole" && cycle.diameter}, {lines === null ? "no program" : `${lines} lines`}
      </p>
      <button type="button" onClick={() => setJob({ format: 1, name: job.name, cycle: { type: "hole", diameter: 44 } })}>
        44 mm
      </button>
      <touch-path
        style={{ height: 640 }}
        job={job}
        theme="light"
        onjob-change={(event) => setJob(event.detail.job)}
        onplan-change={({ detail }) => setLines(detail.plan && detail.plan.program.text.split("\n").length - 1)}
      />
    </>
  );
}

createRoot(document.getElementById("root") as HTMLElement).render(<Probing />);
